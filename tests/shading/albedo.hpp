#pragma once

#include "harness/albedo.hpp"

namespace lobe::test {

using harness::Albedo;
using harness::albedo;

}  // namespace lobe::test
