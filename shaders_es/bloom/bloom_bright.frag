// One texel for a block of pixels: the mean of what each of them has above the threshold. The threshold comes before the
// mean, so that the glow holds the same light wherever a highlight lies in its block.
#include "bloom/bloom.glsl"

FRAGMENT_IN FULL vec2 vertex_uv;  // FULL: half has 2048 places from 0.5 to 1, fewer than a picture 4096 wide
uniform HALF sampler2D image;
FRAGMENT_UNIFORM FULL vec4 texel;  // xy: from one tap to the next. FULL: 1 / 1280 added to a uv is below half's last bit

void main() {  // FULL: uvs
    vec3 sum = vec3(0.0);
    for (int y = 0; y < BLOOM_TAPS; y++) {
        for (int x = 0; x < BLOOM_TAPS; x++) {
            FULL vec2 at = vertex_uv + (vec2(float(x), float(y)) - 0.5 * float(BLOOM_TAPS - 1)) * texel.xy;
            sum += light_above_threshold(light_of_scene_color(sample_2d(image, at).rgb));
        }
    }
    fragment_color = vec4(stored_bloom(sum * (1.0 / float(BLOOM_TAPS * BLOOM_TAPS))), 1.0);
}
