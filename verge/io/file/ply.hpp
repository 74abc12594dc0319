// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verge/io/file/decoded.hpp"
#include "verge/io/input.hpp"

namespace verge::io {

/// PLY 1.0, ascii, binary little-endian and big-endian: the element vertex, with properties of any type and
/// order; x, y, z are needed; intensity, ring and time are taken where a property has one of their names
/// (columns.hpp). Other elements, before and behind, are stepped over (without reading them, where their
/// items have a fixed size); list properties too, at most 4096 numbers each. Fails with kUnusable (line and
/// column in the header and in ascii data, byte offset in binary data), kLimit, kDamaged (no vertices).
[[nodiscard]] Expected<Decoded> read_ply(Input& input);

/// The scan as binary little-endian PLY, in the input's order, atomically: the columns of point_table.hpp,
/// and a comment "stamp_ns N" where the scan has a stamp, since PLY has no integers of 64 bits. Everything of
/// the points comes back bit for bit.
[[nodiscard]] Expected<void> write_ply(const std::filesystem::path& path, const Scan& scan);

}  // namespace verge::io
