#pragma once
// The same for the program's own files: options and JSON besides.

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "cmake/pch.hpp"
