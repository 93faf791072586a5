#include "harness/column_names.hpp"

#include <algorithm>

#include "base/closest_name.hpp"
#include "base/error.hpp"

namespace lobe::harness {
namespace {

constexpr const char* kChannels[3] = {"_r", "_g", "_b"};

}  // namespace

ColumnNames::ColumnNames(const std::vector<std::string>& columns, std::string file)
    : columns_(columns), file_(std::move(file)) {}

std::optional<size_t> ColumnNames::find(const std::string& name) {
    known_.push_back(name);
    const auto found = std::find(columns_.begin(), columns_.end(), name);
    if (found == columns_.end()) return {};
    const auto index = static_cast<size_t>(found - columns_.begin());
    used_.insert(index);
    return index;
}

size_t ColumnNames::require(const std::string& name) {
    if (const auto index = find(name)) return *index;
    fail("no column " + name + "; expected lx, ly, lz, vx, vy, vz" + didYouMean(name, columns_));
}

std::optional<Channels> ColumnNames::findRgb(const std::string& name) {
    const auto all = find(name);
    std::array<std::optional<size_t>, 3> each;
    for (size_t c = 0; c < 3; ++c)
        each[c] = find(name + kChannels[c]);
    const auto there = std::count_if(each.begin(), each.end(), [](const auto& e) { return e.has_value(); });
    if (all && there > 0) fail("columns " + name + " and " + name + "_r, _g or _b; expected either");
    if (all) return Channels{{*all, *all, *all}};
    if (there == 0) return {};
    for (size_t c = 0; c < 3; ++c)
        if (!each[c])
            fail("no column " + name + kChannels[c] + "; expected " + name + "_r, " + name + "_g and " +
                 name + "_b");
    return Channels{{*each[0], *each[1], *each[2]}};
}

void ColumnNames::refuseOthers(const std::string& owner) const {
    for (size_t i = 0; i < columns_.size(); ++i)
        if (!used_.contains(i))
            fail("column '" + columns_[i] + "' is none of " + owner + didYouMean(columns_[i], known_));
}

void ColumnNames::fail(const std::string& what) const {
    throw InputError(file_ + ":1: " + what);
}

}  // namespace lobe::harness
