//! A job for Slurm: an array of tasks, and the merge that waits for it.

use super::plan::{JobFile, Plan, comments, indented, quoted};

/// Both scripts, and how they are submitted.
pub(super) fn files(plan: &Plan) -> (Vec<JobFile>, Vec<String>) {
    let (render, merge) =
        (format!("{}.render.sbatch", plan.name), format!("{}.merge.sbatch", plan.name));
    let commands = vec![
        format!("render=$(sbatch --parsable {})", quoted(&render)),
        format!("sbatch --dependency=afterok:$render {}", quoted(&merge)),
        "squeue --me".to_owned(),
    ];
    let files = vec![
        JobFile { name: render, text: render_text(plan, &commands) },
        JobFile { name: merge, text: merge_text(plan) },
    ];
    (files, commands)
}

fn render_text(plan: &Plan, commands: &[String]) -> String {
    let usage = comments(commands);
    let (samples, tasks) = (plan.samples, plan.tasks());
    let (name, pack) = (quoted(&plan.name), quoted(&plan.pack));
    let flags = plan.flags_text();
    format!(
        "#!/bin/sh
#SBATCH --job-name={name}
#SBATCH --array=0-{last}
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=%x.%a.log
# Renders {samples} samples a pixel in {tasks} tasks of {what}.
# A task that is requeued goes on at its last checkpoint; one that is complete is left alone.
# Submit it from the folder of the pack, which all nodes share:
#
{usage}
set -eu
{find}mkdir -p parts
exec \"${{RTR:-rtr}}\" {pack} --samples \"$first..$end\"{crop} \\
    -o parts/{name}.\"$SLURM_ARRAY_TASK_ID\".exr --resume --skip-complete \\
    --threads \"${{SLURM_CPUS_ON_NODE:-$(nproc)}}\"{flags}
",
        last = tasks - 1,
        what = plan.task_text(),
        find = indented(&plan.task_lines("SLURM_ARRAY_TASK_ID"), ""),
        crop = plan.crop_flag(),
    )
}

fn merge_text(plan: &Plan) -> String {
    let (samples, name) = (plan.samples, quoted(&plan.name));
    format!(
        "#!/bin/sh
#SBATCH --job-name={name}.merge
#SBATCH --output=%x.log
# Adds the parts up; says what is missing, and the command that renders it.
set -eu
exec \"${{RTR:-rtr}}\" merge parts/{name}.*.exr --samples 0..{samples}{frame} -o {name}.exr -o {name}.png
",
        frame = plan.frame_flag(),
    )
}
