#pragma once

#include <string>

namespace lobe::app {

/// What lies beside a baked environment: layouts and formulas, for those who read it without Lobe.
std::string bakedReadme();

}  // namespace lobe::app
