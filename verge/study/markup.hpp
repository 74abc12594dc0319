// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace verge::study {

/// The text with the characters that mean something in HTML and SVG written out; control bytes become spaces.
[[nodiscard]] std::string escape_markup(std::string_view text);

/// RFC 4648 with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace verge::study
