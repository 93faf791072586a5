/// Which tests there are, and which of them are to be run.
#pragma once

#include <string>
#include <vector>

#include "harness/unit/test_file.hpp"
#include "harness/unit/unit_result.hpp"
#include "options.hpp"

namespace lobe::app {

struct Selection {
    std::vector<harness::TestFile> files;         ///< with the chosen tests only
    std::vector<harness::UnitResult> unreadable;  ///< files whose directives are wrong
    size_t found = 0;                             ///< tests before they were chosen from
    size_t chosen() const;
};

/// Throws InputError for a path that does not exist and where there is no test at all, and UsageError where
/// none is left over.
Selection select(const CheckOptions& options);

}  // namespace lobe::app
