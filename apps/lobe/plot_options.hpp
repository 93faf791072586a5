/// Texts of options as numbers, names and models; errors name the option.
#pragma once

#include <string>
#include <vector>

#include "plot/model.hpp"
#include "plot/sampler.hpp"

namespace lobe::app {

/// "0,30,60". Throws UsageError unless all are finite.
std::vector<double> numberList(const std::string& option, const std::string& text);
/// Within the range.
double numberIn(const std::string& option, const std::string& text, double minimum, double maximum);
/// The index of the name; `otherwise` where nothing was written.
size_t choiceOf(const std::string& option, const std::string& text, const std::vector<std::string>& names,
                size_t otherwise = 0);

plot::Channel channelNamed(const std::string& text);

/// "ward,ggx" with "alpha=0.1", which is for all that have it, and "ward.alpha=0.1".
std::vector<plot::Model> modelsOf(const std::string& brdfs, const std::vector<std::string>& assignments);
/// The same where there can be one only.
plot::Model modelOf(const std::string& brdf, const std::vector<std::string>& assignments);

/// A parameter and its values.
struct Sweep {
    std::string over;
    std::vector<double> values;
};

/// `over` or, where empty, the model's width; `range` "low,high" or, where empty, what surfaces use; equal
/// steps, or equal ratios where the range is wide.
Sweep sweepOf(const plot::Model& model, const std::string& over, const std::string& range, int steps);

}  // namespace lobe::app
