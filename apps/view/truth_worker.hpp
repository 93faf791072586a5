/// The true picture, computed beside the window by engine/reference: coarse at first, better with each round.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "edits.hpp"
#include "reference/truth.hpp"

namespace lobe::view {

/// What the truth is of.
struct TruthSubject {
    std::shared_ptr<const Scene> base;
    std::shared_ptr<const app::Settings> settings;
    Edits edits;
    bool operator==(const TruthSubject&) const = default;
};

struct TruthState {
    std::shared_ptr<const Image> image;  ///< of the last round that was finished; null before
    double relativeError = 0.0;          ///< of it
    double aim = 0.0, done = 0.0;        ///< of the round in work; its share that is done, 0 to 1
    bool running = false;
    int rounds = 0;
    std::string error;  ///< why there is none; else empty
};

class TruthWorker {
public:
    explicit TruthWorker(std::function<void()> wake) : wake_(std::move(wake)) {}
    ~TruthWorker() { stop(); }
    TruthWorker(const TruthWorker&) = delete;
    TruthWorker& operator=(const TruthWorker&) = delete;

    void start(const TruthSubject& subject);  ///< stops another one first
    void stop();                              ///< and forgets
    TruthState state() const;
    const TruthSubject& subject() const { return subject_; }

private:
    void run(const TruthSubject& subject);
    std::function<void()> wake_;
    TruthSubject subject_;
    std::atomic<bool> stop_ = false;
    mutable std::mutex mutex_;
    TruthState state_;
    std::thread thread_;
};

}  // namespace lobe::view
