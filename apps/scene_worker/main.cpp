/// Reads scenes for other programs (engine/scene/load.hpp).
#include "import/import.hpp"

int main() {
    return lobe::serveWorker(lobe::serveImport);
}
