/// What a person sees while tests run.
#pragma once

#include "options.hpp"
#include "run_report.hpp"

namespace lobe::app {

class Printer {
public:
    explicit Printer(const CheckOptions& options);
    void result(const harness::UnitResult& result);
    void sum(const RunReport& report) const;

private:
    std::string colored(const char* code, const std::string& text) const;
    bool silent_, quiet_, color_;
    std::string file_;  ///< whose results come now
};

}  // namespace lobe::app
