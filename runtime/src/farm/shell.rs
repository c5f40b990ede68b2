//! A job as a POSIX shell script: one task at a time, or many through GNU parallel.

use super::plan::{JobFile, Plan, comments, indented, quoted};

/// The script, and how it is run.
pub(super) fn files(plan: &Plan) -> (Vec<JobFile>, Vec<String>) {
    let name = format!("{}.job.sh", plan.name);
    let script = quoted(&format!("./{name}"));
    let last = plan.tasks() - 1;
    let commands = vec![
        format!("sh {script} all                       # here, one task after the other"),
        format!("seq 0 {last} | parallel --joblog jobs.log --retries 3 sh {script} task"),
        format!(
            "seq 0 {last} | parallel --sshloginfile nodes --workdir . --retries 3 sh {script} task"
        ),
        format!("sh {script} merge                     # after either of them"),
    ];
    (vec![JobFile { name, text: text(plan, &commands) }], commands)
}

fn text(plan: &Plan, commands: &[String]) -> String {
    let usage = comments(commands);
    let (samples, tasks) = (plan.samples, plan.tasks());
    let (name, pack) = (quoted(&plan.name), quoted(&plan.pack));
    let flags = plan.flags_text();
    format!(
        "#!/bin/sh
# Renders {samples} samples a pixel in {tasks} tasks of {what}, and merges them.
# Tasks may run anywhere, in any order and twice: one that is complete is left alone, one that was
# killed goes on at its last checkpoint. Machines share this folder, or the parts are copied back to it.
#
{usage}
set -eu
RTR=${{RTR:-rtr}}
PACK=${{PACK:-{pack}}}
NAME={name}

# Renders task $1, from 0.
task() {{
{find}    mkdir -p parts
    \"$RTR\" \"$PACK\" --samples \"$first..$end\"{crop} -o \"parts/$NAME.$1.exr\" --resume --skip-complete{flags}
}}

# Adds all parts up; says what is missing.
merge() {{
    \"$RTR\" merge parts/\"$NAME\".*.exr --samples 0..{samples}{frame} -o \"$NAME.exr\" -o \"$NAME.png\"
}}

case \"${{1:-}}\" in
task) task \"$2\" ;;
merge) merge ;;
all)
    i=0
    while [ \"$i\" -lt {tasks} ]; do
        task \"$i\"
        i=$((i + 1))
    done
    merge
    ;;
*)
    echo \"usage: $0 task N | merge | all\" >&2
    exit 2
    ;;
esac
",
        what = plan.task_text(),
        find = indented(&plan.task_lines("$1"), "    "),
        crop = plan.crop_flag(),
        frame = plan.frame_flag(),
    )
}
