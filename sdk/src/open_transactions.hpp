// Which transactions are open on this thread: for the guard, which takes back what a plugin leaves open.
#pragma once

#include <string>
#include <utility>

namespace jet {

class ItemsCenter;

/// Lives as long as a transaction is open; nested ones have one each.
class OpenMark {
public:
    OpenMark() = default;
    /// `rollBack` takes back and closes the innermost open transaction of the center.
    OpenMark(ItemsCenter& center, const std::string& label, void (*rollBack)(ItemsCenter&));
    OpenMark(OpenMark&& other) noexcept : center_(std::exchange(other.center_, nullptr)) {}
    OpenMark& operator=(OpenMark&& other) noexcept
    {
        if (this != &other) {
            close();
            center_ = std::exchange(other.center_, nullptr);
        }
        return *this;
    }
    ~OpenMark() { close(); }
    void close();

private:
    ItemsCenter* center_ = nullptr;
};

}  // namespace jet
