/// The true picture, computed beside the window by engine/reference: coarse at first, better with each round.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
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
    explicit TruthWorker(std::function<void()> wake);
    ~TruthWorker();
    TruthWorker(const TruthWorker&) = delete;
    TruthWorker& operator=(const TruthWorker&) = delete;

    void start(const TruthSubject& subject);  ///< in place of another one; does not wait for its end
    void stop();                              ///< and forgets
    void stopAndWait();                       ///< until nothing of it is in use any more
    TruthState state() const;
    const TruthSubject& subject() const { return subject_; }

private:
    void run();
    void compute(const TruthSubject& subject);
    void change(const std::function<void(TruthState&)>& action);

    std::function<void()> wake_;
    TruthSubject subject_;  ///< the caller's
    std::atomic<bool> stop_ = false;
    mutable std::mutex mutex_;  ///< of all that follows
    std::condition_variable changed_;
    std::optional<TruthSubject> next_;
    bool working_ = false, ended_ = false;
    TruthState state_;
    std::thread thread_;
};

}  // namespace lobe::view
