// What tests of `jet plugins check` share: a fixture plugin is checked, its findings are looked up by name.
#pragma once

#include "cli_fixture.hpp"

#include <map>
#include <string>

namespace jet::test {

class CheckCommandTest : public CliTest {
protected:
    struct Finding {
        std::string name, result, reason, command;
    };

    static std::string folder(const std::string& id) { return "'" + (fixtureFolder() / id).string() + "'"; }

    /// All tests of one fixture, by name.
    std::map<std::string, Finding> check(const std::string& id, const std::string& more = "",
                                         const std::string& environment = "")
    {
        const Outcome run = plain("plugins check " + folder("org.jet.test." + id) + " --json " + more, environment);
        std::map<std::string, Finding> found;
        const auto report = nlohmann::json::parse(run.out, nullptr, false);
        if (!report.is_object()) {
            ADD_FAILURE() << run.out << run.err;
            return found;
        }
        bool failed = false;
        for (const auto& test : report["plugins"][0]["tests"]) {
            const Finding finding{test["name"], test["result"], test.value("reason", ""), test.value("command", "")};
            failed = failed || finding.result == "FAIL";
            found[finding.name] = finding;
        }
        EXPECT_EQ(run.code, failed ? 1 : 0);
        EXPECT_EQ(report["ok"], !failed);
        return found;
    }
    /// The reason of a test that must fail.
    static std::string reason(const std::map<std::string, Finding>& report, const std::string& test)
    {
        const auto found = report.find(test);
        if (found == report.end()) return "there is no test " + test;
        return found->second.result == "FAIL" ? found->second.reason : test + ": " + found->second.result;
    }
};

}  // namespace jet::test
