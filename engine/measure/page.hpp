/// report.html: a report as one page that needs no network, with its pictures, chart and script inside.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

namespace lobe {

/// The bytes of one of the report's pictures, given its path as report.json has it ("pictures/a.png").
using PictureLoader = std::function<std::string(const std::string& file)>;

/// The page of a report of schema 1 (docs/report.md). Pictures are PNG, JPEG or WebP, known by their first
/// bytes. Strings of the report are shown as text, whatever is in them. Throws InputError for another schema,
/// for a picture of another kind, and when the page's own files are missing; passes on what the loader
/// throws.
std::string reportPage(const nlohmann::json& report, const PictureLoader& load);

/// Writes `folder`/report.html, whole or not at all; pictures are read from `folder`. Throws as reportPage(),
/// InputError for a picture that is missing or outside of `folder`, OutputError if the page can't be written.
void writeReportPage(const nlohmann::json& report, const std::filesystem::path& folder);

}  // namespace lobe
