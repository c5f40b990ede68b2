//! A job as a template of Open Job Description, version 2023-09, with chunks of tasks (RFC 1).

use super::plan::{JobFile, Plan, comments, indented, quoted};
use pack::abi::BATCH;

/// The template, and how it is run.
pub(super) fn files(plan: &Plan) -> (Vec<JobFile>, Vec<String>) {
    let name = format!("{}.openjd.yaml", plan.name);
    let file = quoted(&name);
    let commands = vec![
        format!("openjd check {file} --extensions TASK_CHUNKING"),
        format!("openjd run {file} --extensions TASK_CHUNKING --step Render"),
        format!("openjd run {file} --extensions TASK_CHUNKING --step Merge"),
    ];
    (vec![JobFile { name, text: text(plan, &commands) }], commands)
}

/// A text of YAML in double quotes: JSON's escapes are among those of YAML.
fn yaml(text: &str) -> String {
    serde_json::Value::String(text.to_owned()).to_string()
}

/// Of the step that renders, where the frame is cut into crops.
fn tile_parameter(plan: &Plan) -> String {
    let last = plan.tiles() - 1;
    let text = format!("        - {{ name: Tile, type: INT, range: \"0-{last}\" }}\n");
    if plan.tile.is_some() { text } else { String::new() }
}

fn text(plan: &Plan, commands: &[String]) -> String {
    let usage = comments(commands);
    let (samples, batches, chunk) = (plan.samples, plan.batches(), plan.chunk);
    let (name, pack) = (yaml(&plan.name), yaml(&plan.pack));
    let flags = plan.flags_text();
    let exr = yaml(&format!("{}.exr", plan.name));
    let stem = quoted(&plan.name);
    format!(
        "# Renders {samples} samples a pixel, {chunk} batches of {BATCH} samples in a task, and merges them.
# Tasks may run anywhere, in any order and twice: one that is complete is left alone, one that was killed
# goes on at its last checkpoint. On one machine, in the folder of the pack:
#
{usage}specificationVersion: jobtemplate-2023-09
extensions: [TASK_CHUNKING]
name: {name}
parameterDefinitions:
  - {{ name: Pack, type: PATH, objectType: FILE, dataFlow: IN, default: {pack} }}
  - {{ name: Parts, type: PATH, objectType: DIRECTORY, dataFlow: OUT, default: parts }}
  - {{ name: Picture, type: PATH, objectType: FILE, dataFlow: OUT, default: {exr} }}
  - {{ name: Rtr, type: STRING, default: rtr, description: The program }}
  - {{ name: Samples, type: INT, minValue: 1, default: {samples}, description: Samples a pixel }}
  - {{ name: LastBatch, type: INT, minValue: 0, default: {last}, description: \"Samples / {BATCH}, rounded up, less 1\" }}
  - {{ name: ChunkSize, type: INT, minValue: 1, default: {chunk}, description: Batches of a task }}
  - {{ name: Flags, type: STRING, default: {flags}, description: \"More flags of rtr: --size, --device\" }}
steps:
  - name: Render
    parameterSpace:
      taskParameterDefinitions:
        - name: Batch
          type: CHUNK[INT]
          range: \"0-{{{{Param.LastBatch}}}}\"
          chunks: {{ defaultTaskCount: \"{{{{Param.ChunkSize}}}}\", rangeConstraint: CONTIGUOUS }}
{tiles}    script:
      actions:
        onRun: {{ command: sh, args: [\"{{{{Task.File.Run}}}}\"] }}
      embeddedFiles:
        - name: Run
          type: TEXT
          data: |
            set -eu
            batches='{{{{Task.Param.Batch}}}}' # FIRST-LAST, or one
            first=$((${{batches%%-*}} * {BATCH}))
            end=$(((${{batches##*-}} + 1) * {BATCH}))
            if [ \"$end\" -gt {{{{Param.Samples}}}} ]; then end={{{{Param.Samples}}}}; fi
{find}            mkdir -p '{{{{Param.Parts}}}}'
            exec '{{{{Param.Rtr}}}}' '{{{{Param.Pack}}}}' --samples \"$first..$end\"{crop} \\
                -o '{{{{Param.Parts}}}}'/{stem}.{number}\"$first-$end\".exr --resume --skip-complete {{{{Param.Flags}}}}
  - name: Merge
    dependencies: [{{ dependsOn: Render }}]
    script:
      actions:
        onRun: {{ command: sh, args: [\"{{{{Task.File.Run}}}}\"] }}
      embeddedFiles:
        - name: Run
          type: TEXT
          data: |
            set -eu
            exec '{{{{Param.Rtr}}}}' merge '{{{{Param.Parts}}}}'/{stem}.*.exr --samples 0..{{{{Param.Samples}}}}{frame} \\
                -o '{{{{Param.Picture}}}}'
",
        last = batches - 1,
        tiles = tile_parameter(plan),
        find = indented(&plan.tile_lines("{{Task.Param.Tile}}"), "            "),
        number = if plan.tile.is_some() { "\"$tile\"." } else { "" },
        crop = plan.crop_flag(),
        frame = plan.frame_flag(),
        flags = yaml(flags.trim_start()),
    )
}
