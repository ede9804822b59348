// Colour writes are off: this only has to exist.
void main() { fragment_color = vec4(0.0); }
