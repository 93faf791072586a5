namespace lobe {}
