/// Blocks of `///` lines with directives in them.
#pragma once

#include <string>
#include <vector>

#include "harness/unit/directive_reader.hpp"

namespace lobe::harness {

struct Directive {
    std::string name;  ///< without '@'
    std::string text;
    SourcePlace place;
    DirectiveReader reader() const { return {name, text, place}; }
};

struct DirectiveBlock {
    std::vector<Directive> directives;
    size_t end = 0;  ///< index of the line after it
};

const std::vector<std::string>& directiveNames();

/// All blocks that hold a directive of ours. Directives start with '@'; several may share a line, and one
/// whose brackets are still open goes on in the next. Other `///` lines are prose. Throws InputError for a
/// directive that is none.
std::vector<DirectiveBlock> directiveBlocks(const std::vector<std::string>& lines, const std::string& file);

}  // namespace lobe::harness
