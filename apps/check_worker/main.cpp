// lobe-check-worker: compiles and runs what is tested.
#include "harness/unit/unit_worker.hpp"

int main() {
    return lobe::serveWorker(lobe::harness::serveUnitRequest);
}
