/// Times passes: GL_TIMESTAMP queries where they are real, glFinish and the clock on software drivers.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace lobe::gl {

class PassTimer {
public:
    explicit PassTimer(bool reliableTimers);
    ~PassTimer();
    void start();                        ///< before the first pass
    void mark(const std::string& pass);  ///< after each: closes what ran since the last mark under this name
    /// Milliseconds per name, summed over marks of the same name, in order of first mark. Waits for the GPU.
    /// A value that no clock could give (negative, over an hour) is replaced by the wall clock's.
    std::vector<std::pair<std::string, double>> finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lobe::gl
