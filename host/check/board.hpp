// What a test in a child process says while it runs, in a file both map: it is there to read when the child has
// crashed, was killed, or left by exit().
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace jet::host::check {

class Board {
public:
    /// Makes the file if need be; throws Failure when it cannot.
    explicit Board(const std::filesystem::path& file);
    ~Board();
    Board(const Board&) = delete;
    Board& operator=(const Board&) = delete;

    /// What is being done, e.g. "edit 12", and the callback of the plugin that is being called.
    void activity(std::string_view text) { write(0, text); }
    void callback(std::string_view text) { write(1, text); }
    /// Why the test failed.
    void reason(std::string_view text) { write(2, text); }
    /// The test came to its end.
    void done() { write(3, "done"); }

    std::string activity() const { return read(0); }
    std::string callback() const { return read(1); }
    std::string reason() const { return read(2); }
    bool isDone() const { return !read(3).empty(); }

private:
    void write(std::size_t field, std::string_view text);
    std::string read(std::size_t field) const;
    char* memory_ = nullptr;
};

}  // namespace jet::host::check
