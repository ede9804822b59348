// tinygltf and its image decoder, compiled here so that the fuzzer sees into them. Not ours: their warnings are off.
#pragma GCC diagnostic ignored "-Weverything"
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_INCLUDE_JSON
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <nlohmann/json.hpp>

#include <tiny_gltf.h>
