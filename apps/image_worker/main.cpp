/// lobe-image-worker: reads and writes picture files for the other programs, which start it
/// (base/worker.hpp).
#include <malloc.h>

#include "base/worker.hpp"
#include "codec/codec.hpp"

int main() {
    // One heap: each further one would reserve 64 MiB of the address space that is limited.
    mallopt(M_ARENA_MAX, 1);
    return lobe::serveWorker(lobe::codec::serve);
}
