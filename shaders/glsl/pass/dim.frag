/// dim.frag - what blended surfaces let through, to be multiplied with what lies behind them.
uniform sampler2D uTransmittance;
layout(location = 0) out vec4 oTransmittance;

void main() { oTransmittance = vec4(texelFetch(uTransmittance, ivec2(gl_FragCoord.xy), 0).rgb, 1.0); }
