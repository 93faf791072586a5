// Its writing half, which is not used, needs this header but includes it only together with its file
// functions.
#include <fstream>

#define TINYGLTF_IMPLEMENTATION
#include "import/tinygltf.hpp"
