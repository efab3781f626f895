#pragma once
// The two kinds of failure that are not the scene's fault; `tools` gives each its exit code.

#include "anim/error.h"

namespace gridreel::sequences {

/// What was asked for makes no sense, whatever the scene (exit 2).
class UsageError : public Error {
public:
    using Error::Error;
};

/// A frame, log or folder cannot be written (exit 4).
class OutputError : public Error {
public:
    using Error::Error;
};

}  // namespace gridreel::sequences
