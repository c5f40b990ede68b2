//! Materials → the tables of directional albedo that the kernel reads for them.
//!
//! The tables are made by `cargo run --release -p tests --bin albedo -- --write`; this only picks those in use.

use pack::abi::{self, AlbedoTable, albedo_tables};

/// Every table, one after the other as in [`AlbedoTable::ALL`]: `f32`, little-endian.
const TABLES: &[u8] = include_bytes!("albedo.f32");

/// The words of one table.
#[must_use]
pub fn table(of: AlbedoTable) -> Vec<[f32; 4]> {
    let before = AlbedoTable::ALL.into_iter().take_while(|table| *table != of);
    let first = before.map(AlbedoTable::words).sum::<usize>();
    let bytes = &TABLES[16 * first..16 * (first + of.words())];
    bytes.as_chunks::<16>().0.iter().map(word).collect()
}

fn word(bytes: &[u8; 16]) -> [f32; 4] {
    let values = bytes.as_chunks::<4>().0;
    std::array::from_fn(|k| f32::from_le_bytes(values[k]))
}

/// The ALBEDO section of these materials.
pub(super) fn words(materials: &[abi::Material]) -> Vec<[f32; 4]> {
    let tables = AlbedoTable::ALL.into_iter().zip(albedo_tables(materials));
    tables.filter(|(_, first)| first.is_some()).flat_map(|(of, _)| table(of)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_holds_every_table() {
        let all: usize = AlbedoTable::ALL.into_iter().map(AlbedoTable::words).sum();
        assert_eq!(TABLES.len(), 16 * all);
        assert_eq!(words(&[]), Vec::<[f32; 4]>::new());
    }
}
