//! Prints the kernel that knows everything, or, with the argument `empty`, the one that knows nothing.

#[expect(clippy::print_stdout, reason = "printing is what this example is for")]
fn main() -> Result<(), shaders::ShaderError> {
    let empty = std::env::args().any(|argument| argument == "empty");
    let features = if empty { shaders::FeatureSet::empty() } else { shaders::FeatureSet::full() };
    let linked = shaders::link(&features)?;
    println!("{}", linked.text);
    shaders::validate(&linked)?;
    Ok(())
}
