#include "pick.hpp"

#include "reference/tracer.hpp"

namespace lobe::view {

std::optional<Picked> pick(const std::shared_ptr<const Scene>& scene, const Camera& camera, int width,
                           int height, double x, double y) {
    const View view = makeView(camera, width, height);
    const reference::Tracer tracer(scene, view.eye);
    std::vector<reference::SurfacePoint> layers;
    tracer.surfacesAlong(reference::pixelRay(view, x, height - y), nullptr, layers);
    if (layers.empty()) return {};
    const reference::SurfacePoint& front = layers.front();
    return Picked{front.material, static_cast<int>(front.instance), front.position, front.normal,
                  front.distance};
}

}  // namespace lobe::view
