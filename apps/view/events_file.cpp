#include "events_file.hpp"

#include "base/error.hpp"

namespace lobe::view {

EventsFile::EventsFile(const std::string& file) {
    if (file.empty()) return;
    stream_.open(file, std::ios::binary | std::ios::trunc);
    if (!stream_) throw OutputError(file + ": can't be written (--events)");
}

void EventsFile::add(const std::string& event, nlohmann::json values) {
    if (!stream_.is_open()) return;
    values["event"] = event;
    stream_ << values.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
}

void EventsFile::place(const std::string& control, float x, float y, float width, float height) {
    if (!stream_.is_open()) return;
    nlohmann::json place = {{"name", control}, {"x", x}, {"y", y}, {"width", width}, {"height", height}};
    nlohmann::json& known = places_[control];
    if (known == place) return;
    known = place;
    add("control", std::move(place));
}

}  // namespace lobe::view
