/// A line of JSON for each thing that happens (--events FILE), for tests and for reports of faults.
#pragma once

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace lobe::view {

class EventsFile {
public:
    /// An empty name writes nothing. Throws OutputError.
    explicit EventsFile(const std::string& file);

    bool used() const { return stream_.is_open(); }
    void add(const std::string& event, nlohmann::json values);
    /// Where a control is, in window coordinates; a line when that changes.
    void place(const std::string& control, float x, float y, float width, float height);

private:
    std::ofstream stream_;
    std::map<std::string, nlohmann::json> places_;
};

}  // namespace lobe::view
