// Final quality: the mean of the accumulated samples, encoded.
uniform sampler2D accumulated;
uniform int sampleCount;

out vec4 pixel;

void main() { pixel = vec4(encodeBytes(texelFetch(accumulated, ivec2(gl_FragCoord.xy), 0).rgb / float(sampleCount)), 1.0); }
