// tinygltf, compiled here so that the fuzzer sees into it. Not ours: its warnings are off.
#pragma GCC diagnostic ignored "-Weverything"
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_INCLUDE_JSON
#include <nlohmann/json.hpp>

#include <tiny_gltf.h>
