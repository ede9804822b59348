// tinygltf's image decoder, compiled here so that the fuzzer sees into it. Not ours: its warnings are off.
#pragma GCC diagnostic ignored "-Weverything"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image.h>
#include <stb_image_write.h>
