// Where in a JSON text a value stands, so that a complaint about it can name a byte.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string_view>

namespace relievo {

// Offset of the first byte of `value`, which is a part of `document`, the document that `text` was parsed to; that of the document itself
// where it is not found. Linear in the text: for messages.
std::size_t byte_of(std::string_view text, const nlohmann::json& document, const nlohmann::json& value);

}  // namespace relievo
