/// A scene that comes on standard input.
#pragma once

#include <filesystem>

namespace lobe::app {

/// Standard input as a file that the scene worker can open: "stdin.glb" or "stdin.gltf", told by its first
/// bytes, in a folder of its own that is removed when the program ends. Read once; later calls give the same
/// file. Throws InputError if it is empty or can't be read or kept.
std::filesystem::path standardInputScene();

}  // namespace lobe::app
