/// A scene as bytes, for the way from the scene worker to the program. Not a file format: no version, same
/// build only.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scene/scene.hpp"

namespace lobe {

std::vector<std::byte> toBytes(const Scene& scene);
Scene sceneFromBytes(std::span<const std::byte> bytes);  ///< throws InputError if they are no scene

}  // namespace lobe
