#include "harness/unit/unit_result.hpp"

namespace lobe::harness {
namespace {

constexpr const char* kStatusNames[] = {"passed", "failed", "error"};

nlohmann::ordered_json toJson(const UnitFailure& failure) {
    nlohmann::ordered_json json = {{"place", failure.place}, {"expected", failure.expected}};
    json["inputs"] = nlohmann::ordered_json::array();
    for (const FailedInput& input : failure.inputs)
        json["inputs"].push_back(
            {{"name", input.name}, {"type", input.type}, {"value", input.value}, {"literal", input.literal}});
    json["values"] = nlohmann::ordered_json::array();
    for (const auto& [name, value] : failure.values)
        json["values"].push_back({{"name", name}, {"value", value}});
    json["regression"] = failure.regression;
    return json;
}

UnitFailure failureFrom(const nlohmann::json& json) {
    UnitFailure failure;
    failure.place = json.at("place");
    failure.expected = json.at("expected");
    failure.regression = json.at("regression");
    for (const auto& input : json.at("inputs"))
        failure.inputs.push_back(
            {input.at("name"), input.at("type"), input.at("value"), input.at("literal")});
    for (const auto& value : json.at("values"))
        failure.values.emplace_back(value.at("name"), value.at("value"));
    return failure;
}

}  // namespace

nlohmann::ordered_json toJson(const UnitResult& result) {
    nlohmann::ordered_json json = {{"file", result.file},
                                   {"line", result.line},
                                   {"name", result.name},
                                   {"tags", result.tags},
                                   {"status", kStatusNames[static_cast<size_t>(result.status)]},
                                   {"exit_code", static_cast<int>(result.code)},
                                   {"inputs", result.rows},
                                   {"failing", result.failing},
                                   {"skipped", result.skipped},
                                   {"seed", result.seed},
                                   {"milliseconds", result.milliseconds}};
    if (!result.message.empty()) json["message"] = result.message;
    if (result.mustFail) json["must_fail"] = *result.mustFail;
    if (result.failure) json["failure"] = toJson(*result.failure);
    return json;
}

UnitResult unitResultFrom(const nlohmann::json& json) {
    UnitResult result;
    result.file = json.at("file");
    result.line = json.at("line");
    result.name = json.at("name");
    result.tags = json.at("tags").get<std::vector<std::string>>();
    const std::string status = json.at("status");
    result.status = status == "passed"   ? UnitResult::Status::passed
                    : status == "failed" ? UnitResult::Status::failed
                                         : UnitResult::Status::error;
    result.code = static_cast<ExitCode>(json.at("exit_code").get<int>());
    result.rows = json.at("inputs");
    result.failing = json.at("failing");
    result.skipped = json.at("skipped");
    result.seed = json.at("seed");
    result.milliseconds = json.at("milliseconds");
    result.message = json.value("message", "");
    if (json.contains("must_fail")) result.mustFail = json["must_fail"].get<std::string>();
    if (json.contains("failure")) result.failure = failureFrom(json["failure"]);
    return result;
}

}  // namespace lobe::harness
