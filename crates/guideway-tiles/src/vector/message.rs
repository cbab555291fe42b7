//! Protocol buffers: fields of numbers and bytes, as far as vector tiles need them.

/// Appends a whole number, seven bits per byte, the lowest first.
pub(super) fn varint(out: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        out.push(value as u8 | 0x80);
        value >>= 7;
    }
    out.push(value as u8);
}

/// Maps signed numbers to small unsigned ones: 0, -1, 1, -2 to 0, 1, 2, 3.
pub(super) fn zigzag(value: i64) -> u64 {
    (value << 1 ^ value >> 63).cast_unsigned()
}

/// Appends a field with a whole number.
pub(super) fn number(out: &mut Vec<u8>, field: u32, value: u64) {
    varint(out, u64::from(field << 3));
    varint(out, value);
}

/// Appends a field with a number in 64 bits.
pub(super) fn double(out: &mut Vec<u8>, field: u32, value: f64) {
    varint(out, u64::from(field << 3 | 1));
    out.extend_from_slice(&value.to_le_bytes());
}

/// Appends a field with bytes: a text, a message or a packed list.
pub(super) fn bytes(out: &mut Vec<u8>, field: u32, value: &[u8]) {
    head(out, field, value.len());
    out.extend_from_slice(value);
}

/// Appends what is before the bytes of a field.
pub(super) fn head(out: &mut Vec<u8>, field: u32, length: usize) {
    varint(out, u64::from(field << 3 | 2));
    varint(out, length as u64);
}

/// Bytes that a whole number takes.
pub(super) fn number_bytes(value: u64) -> usize {
    (value | 1).ilog2() as usize / 7 + 1
}

/// Appends a field with a packed list of whole numbers, by way of a list of bytes.
pub(super) fn packed(out: &mut Vec<u8>, field: u32, values: &[u32], list: &mut Vec<u8>) {
    list.clear();
    values
        .iter()
        .for_each(|&value| varint(list, u64::from(value)));
    bytes(out, field, list);
}
