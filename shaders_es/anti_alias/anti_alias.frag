// Smooths the staircases of the finished picture. A pixel beside an edge walks along it to both ends of its run; where
// the staircase steps towards the pixel, it takes the share of its neighbour that the straight line would cover.
//
// What looks like a corner is left alone: there the line does not go on in the next row. So rectangles, axis-aligned
// lines and letters stay as they are, to the bit, and so does everything without an edge.
#include "anti_alias/anti_alias.glsl"

FRAGMENT_IN FULL vec2 vertex_uv;  // FULL: half has 2048 places from 0.5 to 1, fewer than a picture 4096 wide
uniform HALF sampler2D picture;
FRAGMENT_UNIFORM FULL vec4 texel;  // xy: one pixel. FULL: 1 / 1280 added to a uv is below half's last bit

// FULL: a uv is made of it.
//@domain pixels: -8..8; FULL vec2 vertex_uv: 0..1; FULL vec4 texel: 0..0.01; HALF sampler2D picture: 0..1
//@exempt half_flushed, es_minimum: within 3.0 * exp2(-14.0); the three products of edge_luma
//@promise in 0..1
//@jumps step(0.5, vertex_uv.x + pixels.x * texel.x)
float luma_at(FULL vec2 pixels) { return edge_luma(sample_2d(picture, vertex_uv + pixels * texel.xy).rgb); }

// Pixels from this one to the end of the run, up to the reach; `end` becomes the luma there less `middle`, or 0.
//@domain start, along: -1..1; middle: 0..1; enough: 0.02..0.5; FULL vec2 vertex_uv: 0..1; FULL vec4 texel: 0.0005..0.01; HALF sampler2D picture: 0..1
//@promise in -8.5..8.5
//@jumps clamp(floor((0.5 - vertex_uv.x - start.x * texel.x) / (along.x * texel.x)), 0.0, 9.0); step(enough, abs(edge_luma(picture[0].rgb) - middle)); step(enough, abs(edge_luma(picture[1].rgb) - middle))
float walk(vec2 start, vec2 along, float middle, float enough, out float end) {
    end = 0.0;
    for (int i = 1; i <= ANTI_ALIAS_REACH; i++) {
        float difference = luma_at(start + along * float(i)) - middle;
        if (abs(difference) >= enough) {
            end = difference;
            return float(i) - 0.5;
        }
    }
    return float(ANTI_ALIAS_REACH) + 0.5;
}

void main() {
    vec3 here = sample_2d(picture, vertex_uv).rgb;
    fragment_color = vec4(here, 1.0);
    float centre = edge_luma(here);
    float up = luma_at(vec2(0.0, 1.0));
    float down = luma_at(vec2(0.0, -1.0));
    float left = luma_at(vec2(-1.0, 0.0));
    float right = luma_at(vec2(1.0, 0.0));
    float brightest = max(centre, max(max(up, down), max(left, right)));
    float darkest = min(centre, min(min(up, down), min(left, right)));
    if (brightest - darkest < edge_contrast(brightest)) return;

    // The edge runs across the direction in which luma bends most in this and the two rows beside it: at the corner of a
    // step this row alone bends both ways alike.
    float up_left = luma_at(vec2(-1.0, 1.0));
    float up_right = luma_at(vec2(1.0, 1.0));
    float down_left = luma_at(vec2(-1.0, -1.0));
    float down_right = luma_at(vec2(1.0, -1.0));
    float bend_y = 2.0 * abs(up + down - 2.0 * centre) + abs(up_left + down_left - 2.0 * left) +
                   abs(up_right + down_right - 2.0 * right);
    float bend_x = 2.0 * abs(left + right - 2.0 * centre) + abs(up_left + up_right - 2.0 * up) +
                   abs(down_left + down_right - 2.0 * down);
    bool horizontal = bend_y >= bend_x;
    float plus = horizontal ? up : right;
    float minus = horizontal ? down : left;
    vec2 across = horizontal ? vec2(0.0, 1.0) : vec2(1.0, 0.0);
    float other = abs(plus - centre) >= abs(minus - centre) ? plus : minus;
    if (abs(plus - centre) < abs(minus - centre)) across = -across;

    // Between the two rows the sampler gives their mean, until one of the rows changes sides.
    float middle = 0.5 * (centre + other);
    float enough = 0.25 * abs(other - centre);
    vec2 along = across.yx;
    float forward_end;
    float backward_end;
    float forward = walk(0.5 * across, along, middle, enough, forward_end);
    float backward = walk(0.5 * across, -along, middle, enough, backward_end);
    bool forward_is_near = forward < backward;
    float near_end = forward_is_near ? forward : backward;
    float end = forward_is_near ? forward_end : backward_end;
    // The run must end on the other side's luma: else the staircase steps away, and the neighbour is the one to change.
    if (end * (other - centre) <= 0.0) return;
    // And behind the end the edge must go on in the row behind this one: else it is a corner.
    vec2 behind = (forward_is_near ? along : -along) * (near_end + 0.5) - across;
    if (abs(luma_at(behind) - centre) > abs(luma_at(behind) - other)) return;
    float share = edge_share(near_end, max(forward, backward));
    // The sampler mixes: `share` of a pixel towards the neighbour is `share` of the neighbour.
    fragment_color.rgb = sample_2d(picture, vertex_uv + share * across * texel.xy).rgb;
}
