#pragma once
// What nearly every file includes anyway, read once (cmake/room.cmake). No file relies on it: each
// includes what it uses, and a build with CMAKE_DISABLE_PRECOMPILE_HEADERS=ON works as well.

#include <fmt/format.h>

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>
