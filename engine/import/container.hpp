/// The outermost layer of a scene file: JSON text alone, or a binary container (GLB 2) with a JSON and a BIN
/// chunk.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lobe {

struct Container {
    std::string_view json;
    std::optional<std::span<const std::byte>> bin;
};

/// Views into `bytes`. Throws InputError.
Container openContainer(std::span<const std::byte> bytes, const std::string& file);

/// Parses JSON that is nested no deeper than what a recursive reader survives. Throws InputError.
nlohmann::json parseJson(std::string_view text, const std::string& file);

}  // namespace lobe
