#pragma once

namespace genio::cli {

/// What the program was compiled for and the processor at hand lacks; nullptr: nothing. The program
/// asks before anything else of it runs, and ends with one line where something is lacking.
const char* lacking_of_processor();

}  // namespace genio::cli
