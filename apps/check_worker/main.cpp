// lobe-check-worker: compiles and runs what is tested.
#include "base/worker.hpp"

int main() {
    return lobe::serveWorker([](const lobe::Message&) { return lobe::Message{}; });
}
