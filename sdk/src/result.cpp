#include <jet/result.hpp>

namespace jet {

std::string Error::text() const
{
    std::string out = where.file;
    if (where.line > 0) {
        out += (out.empty() ? "line " : ":") + std::to_string(where.line);
        if (where.column > 0) out += ":" + std::to_string(where.column);
    }
    if (!out.empty()) out += ": ";
    return out + "error: " + message;
}

Failure::Failure(Error error) : std::runtime_error(error.message), error_(std::move(error)) {}
Failure::Failure(const Failure&) = default;
Failure::~Failure() = default;

}  // namespace jet
