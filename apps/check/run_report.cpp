#include "run_report.hpp"

#include <algorithm>
#include <iostream>
#include <pugixml.hpp>
#include <sstream>

#include "base/atomic_file.hpp"
#include "lobe_paths.hpp"

namespace lobe::app {
namespace {

using harness::UnitResult;
using Status = UnitResult::Status;

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines)
        text += line + "\n";
    return text;
}

/// Characters that XML 1.0 can't hold, such as a driver's control characters, become '?'.
std::string xmlText(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') c = '?';
    return text;
}

void appendCase(pugi::xml_node suite, const UnitResult& result) {
    pugi::xml_node test = suite.append_child("testcase");
    test.append_attribute("name") = xmlText(result.name).c_str();
    test.append_attribute("classname") = xmlText(result.file).c_str();
    test.append_attribute("file") = xmlText(result.file).c_str();
    test.append_attribute("line") = result.line;
    test.append_attribute("time") = result.milliseconds / 1000.0;
    if (result.status == Status::passed) return;
    const std::vector<std::string> lines = failureLines(result);
    pugi::xml_node node = test.append_child(result.status == Status::failed ? "failure" : "error");
    node.append_attribute("message") = xmlText(lines.empty() ? "" : lines.front()).c_str();
    node.append_child(pugi::node_pcdata).set_value(xmlText(joined(lines)).c_str());
}

}  // namespace

size_t RunReport::count(Status status) const {
    return static_cast<size_t>(std::count_if(
        results.begin(), results.end(), [&](const UnitResult& result) { return result.status == status; }));
}

ExitCode RunReport::exitCode() const {
    for (const ExitCode code : {ExitCode::unreadableInput, ExitCode::shader})
        for (const UnitResult& result : results)
            if (result.status == Status::error && result.code == code) return code;
    for (const UnitResult& result : results)
        if (result.status != Status::passed) return ExitCode::checkFailed;
    return ExitCode::ok;
}

std::vector<std::string> failureLines(const UnitResult& result) {
    std::vector<std::string> lines = linesOf(result.message);
    // A must-fail test that did fail has nothing to explain.
    if (!result.failure || result.status == Status::passed) return lines;
    const harness::UnitFailure& failure = *result.failure;
    size_t width = 8;
    for (const auto& input : failure.inputs)
        width = std::max(width, input.name.size());
    for (const auto& [name, value] : failure.values)
        width = std::max(width, name.size());
    const auto add = [&](const std::string& name, const std::string& value) {
        bool first = true;
        for (const std::string& line : linesOf(value)) {
            lines.push_back((first ? name : "") + std::string(width + 2 - (first ? name.size() : 0), ' ') +
                            line);
            first = false;
        }
    };
    add("expected", failure.expected + "   (" + failure.place + ")");
    for (const auto& input : failure.inputs)
        add(input.name, input.value);
    for (const auto& [name, value] : failure.values)
        add(name, value);
    lines.emplace_back("The simplest input that was found, as a test to keep (seed " +
                       std::to_string(result.seed) + "):");
    for (const std::string& line : linesOf(failure.regression))
        lines.push_back("    " + line);
    return lines;
}

std::string junitXml(const RunReport& report) {
    pugi::xml_document document;
    pugi::xml_node declaration = document.append_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    declaration.append_attribute("encoding") = "UTF-8";
    pugi::xml_node root = document.append_child("testsuites");
    pugi::xml_node suite = root.append_child("testsuite");
    for (pugi::xml_node node : {root, suite}) {
        node.append_attribute("name") = "lobe-check";
        node.append_attribute("tests") = static_cast<unsigned>(report.results.size());
        node.append_attribute("failures") = static_cast<unsigned>(report.count(Status::failed));
        node.append_attribute("errors") = static_cast<unsigned>(report.count(Status::error));
        node.append_attribute("time") = report.seconds;
    }
    pugi::xml_node properties = suite.append_child("properties");
    for (const auto& [name, value] :
         {std::pair("backend", report.backend), std::pair("renderer", report.renderer)}) {
        pugi::xml_node property = properties.append_child("property");
        property.append_attribute("name") = name;
        property.append_attribute("value") = xmlText(value).c_str();
    }
    for (const UnitResult& result : report.results)
        appendCase(suite, result);
    std::ostringstream text;
    document.save(text, "  ");
    return text.str();
}

std::string jsonText(const RunReport& report) {
    nlohmann::ordered_json json = {{"schema", 1},
                                   {"version", paths::kVersion},
                                   {"backend", report.backend},
                                   {"renderer", report.renderer},
                                   {"seconds", report.seconds},
                                   {"passed", report.count(Status::passed)},
                                   {"failed", report.count(Status::failed)},
                                   {"errors", report.count(Status::error)},
                                   {"tests", nlohmann::ordered_json::array()}};
    for (const UnitResult& result : report.results)
        json["tests"].push_back(harness::toJson(result));
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string tapText(const RunReport& report) {
    std::string text = "TAP version 13\n1.." + std::to_string(report.results.size()) + "\n";
    size_t number = 0;
    for (const UnitResult& result : report.results) {
        std::string name = result.file + ": " + result.name;
        std::replace(name.begin(), name.end(), '#', '_');  // would start a directive
        text += (result.status == Status::passed ? "ok " : "not ok ") + std::to_string(++number) + " - " +
                name + "\n";
        for (const std::string& line : failureLines(result))
            text += "# " + line + "\n";
    }
    return text;
}

void writeReport(const std::string& target, const std::string& text) {
    if (target == "-")
        std::cout << text;
    else if (!target.empty())
        writeAtomically(target, text);
}

}  // namespace lobe::app
