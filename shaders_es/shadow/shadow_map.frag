// Depth alone; a masked caster leaves out what the mask leaves out, by the rule of surface.frag.
#ifdef ALPHA_MASK
FRAGMENT_UNIFORM HALF vec4 mask;  // x alpha, y cutoff
#ifdef BASE_COLOR_MAP
uniform HALF sampler2D base_color_map;
FRAGMENT_IN FULL vec2 vertex_uv;  // FULL: as in surface.vert, so that both leave out the same
#endif
#ifdef VERTEX_COLOR
FRAGMENT_IN HALF float vertex_alpha;
#endif
#endif

void main() {
#ifdef ALPHA_MASK
    float alpha = mask.x;
#ifdef VERTEX_COLOR
    alpha *= vertex_alpha;
#endif
#ifdef BASE_COLOR_MAP
    alpha *= sample_2d(base_color_map, vertex_uv).a;
#endif
    if (alpha < mask.y) discard;
#endif
    fragment_color = vec4(0.0);  // no colour is bound: this only has to exist
}
