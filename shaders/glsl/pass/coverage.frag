/// coverage.frag - coverage 1 where there is a surface.
layout(location = 0) out vec4 oRadiance;

void main() { oRadiance = vec4(0.0, 0.0, 0.0, 1.0); }
