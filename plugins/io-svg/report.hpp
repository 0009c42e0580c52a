// Report: gathers what could not be kept, one note a kind with how many and where first, instead of one a case.
#pragma once

#include "source_text.hpp"

#include <jet/format.hpp>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace jet::svg {

class Report {
public:
    Report(const SourceText& source, std::vector<FormatNote>& notes) : source_(source), notes_(notes) {}
    Report(const Report&) = delete;
    ~Report();  ///< writes the counted kinds to the notes, in the order of their places

    /// A remark of its own.
    void note(std::string message, std::size_t offset);
    /// One more of a kind; `message` says what was done about it: "text is not drawn".
    void count(std::string_view message, std::size_t offset);

    /// While one lives, nothing is taken down: for reading again what was read before.
    class Silence {
    public:
        explicit Silence(Report& report) : report_(report) { ++report_.silent_; }
        ~Silence() { --report_.silent_; }
        Silence(const Silence&) = delete;

    private:
        Report& report_;
    };

private:
    struct Kind {
        std::size_t first = 0;
        int times = 0;
    };

    const SourceText& source_;
    std::vector<FormatNote>& notes_;
    std::map<std::string, Kind, std::less<>> kinds_;
    int single_ = 0;
    int silent_ = 0;
};

}  // namespace jet::svg
