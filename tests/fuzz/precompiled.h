// Nothing but what nearly every file compiled for libFuzzer reads, after what clang 14 lacks.
#pragma once

#include "tests/fuzz/source_location.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
