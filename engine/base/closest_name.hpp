#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lobe {

/// The candidate nearest to `name` by edit distance (Damerau's, adjacent swaps count one), or nothing when
/// even the nearest differs in more than a third of its letters. Ties go to the earlier candidate. Letter
/// case and the difference between '-' and '_' do not count.
std::optional<std::string> closestName(std::string_view name, const std::vector<std::string>& candidates);

/// "; did you mean 'NAME'?" or the empty string: to be appended to a message about an unknown name.
std::string didYouMean(std::string_view name, const std::vector<std::string>& candidates);

/// "a, b, c".
std::string listed(const std::vector<std::string>& names);

}  // namespace lobe
