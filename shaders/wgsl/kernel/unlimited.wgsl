// Paths of any length, which end by Russian roulette alone.

// From this bounce on the chance to survive is below 1: the longest path that a scene may ask for otherwise.
const UNLIMITED_FROM: u32 = 1024u;

// 1 - 2^-10. Unbiased, as every chance is; the variance is finite where the square of the albedo is less.
const UNLIMITED_SURVIVAL: f32 = 0.9990234375;

// The chance to survive `bounce` of a path whose throughput asks for `q`. Where nothing is lost, in a room of perfect
// mirrors, q is 1, and the path would never end.
fn unlimited_survival(bounce: u32, q: f32) -> f32 {
    return select(q, min(q, UNLIMITED_SURVIVAL), bounce >= UNLIMITED_FROM);
}
