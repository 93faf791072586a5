/// The columns of a table by their names: found, required, and those that nobody asked for refused.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace lobe::harness {

/// Places of the columns of an rgb quantity: three, or one three times.
struct Channels {
    std::array<size_t, 3> at{};
};

/// Finds columns by name and remembers which were asked for. What does not fit throws InputError "FILE:1:
/// ...".
class ColumnNames {
public:
    /// `columns` must outlive it; `file` is for messages.
    ColumnNames(const std::vector<std::string>& columns, std::string file);

    std::optional<size_t> find(const std::string& name);
    size_t require(const std::string& name);
    /// One column NAME for all channels, or NAME_r, NAME_g and NAME_b.
    std::optional<Channels> findRgb(const std::string& name);
    /// Throws for a column that was not asked for, with the nearest name that was; `owner` would have it.
    void refuseOthers(const std::string& owner) const;
    [[noreturn]] void fail(const std::string& what) const;

private:
    const std::vector<std::string>& columns_;
    std::string file_;
    std::set<size_t> used_;
    std::vector<std::string> known_;
};

}  // namespace lobe::harness
