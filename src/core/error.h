// What a user can cause: said as an attempt, its subject and a way on. Programmer's mistakes are asserts.
#pragma once

#include <stdexcept>
#include <string>

namespace relievo {

class Error : public std::runtime_error {
public:
    // "cannot <attempt> <subject>: <reason>" and, where there is one, a line of advice.
    Error(const std::string& attempt, const std::string& subject, const std::string& reason, const std::string& advice = {})
        : std::runtime_error("cannot " + attempt + " " + subject + ": " + reason + (advice.empty() ? "" : "\n  " + advice)) {}
};

// A command that could not be understood (exit code 2), as opposed to work that failed (exit code 1).
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// The user asked to stop; everything temporary is removed while the stack unwinds.
class Cancelled : public std::runtime_error {
public:
    Cancelled() : std::runtime_error("interrupted") {}
};

}  // namespace relievo
