#include "cli_fixture.hpp"

#include <csignal>
#include <cstdio>
#include <thread>

namespace jet::test {
namespace {

using testing::Not;
namespace fs = std::filesystem;

/// A web server on this machine for the folder, until destroyed.
class Server {
public:
    explicit Server(const fs::path& folder)
    {
        const std::string command = "echo $$; exec python3 -u -m http.server 0 --bind 127.0.0.1 --directory '" +
                                    folder.string() + "' 2>/dev/null";
        pipe_ = ::popen(command.c_str(), "r");
        if (!pipe_) return;
        char line[256] = {};
        if (std::fgets(line, sizeof line, pipe_)) pid_ = std::atoi(line);
        if (std::fgets(line, sizeof line, pipe_)) std::sscanf(line, "Serving HTTP on 127.0.0.1 port %d", &port_);
    }
    ~Server()
    {
        if (pid_ > 0) ::kill(pid_, SIGTERM);
        if (pipe_) ::pclose(pipe_);
    }
    std::string address() const { return "http://127.0.0.1:" + std::to_string(port_); }
    int port() const { return port_; }

private:
    std::FILE* pipe_ = nullptr;
    int pid_ = 0, port_ = 0;
};

class PackagesTest : public CliTest {
protected:
    /// A built plugin: the fixture "good" under another id, version and requirements.
    std::string built(const std::string& id, const std::string& version = "1.0.0", std::vector<std::string> needs = {},
                      const std::string& library = "")
    {
        const fs::path from = fixtureFolder() / "org.jet.test.good", to = home() / "built" / (id + version);
        fs::create_directories(to);
        auto manifest = json(readAnywhere(from / "plugin.json"));
        manifest["id"] = id;
        manifest["version"] = version;
        manifest["requires"] = needs;
        const std::string file = manifest["library"].get<std::string>() + ".so";
        std::ofstream(to / "plugin.json") << manifest.dump(1);
        if (library.empty())
            fs::copy_file(from / file, to / file, fs::copy_options::overwrite_existing);
        else
            std::ofstream(to / file) << library;
        return to.string();
    }
    std::string packed(const std::string& id, const std::string& version = "1.0.0", std::vector<std::string> needs = {},
                       const std::string& library = "")
    {
        fs::create_directories(home() / "repo");
        const std::string file = "repo/" + id + "-" + version + ".jetplugin";
        const Outcome done = plain("plugins pack '" + built(id, version, std::move(needs), library) + "' " + file);
        EXPECT_EQ(done.code, 0) << done.err;
        return file;
    }
    static std::string readAnywhere(const fs::path& file)
    {
        std::ifstream in(file);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    /// Version of the plugin in the user's folder; empty if it is not there.
    std::string version(const std::string& id) const
    {
        const std::string text = read("data/jet/plugins/" + id + "/plugin.json");
        return text.empty() ? "" : json(text)["version"].get<std::string>();
    }
    /// What there is besides whole plugins: nothing but the lock.
    std::vector<std::string> leftovers() const
    {
        std::vector<std::string> names;
        std::error_code ignored;
        for (const auto& entry : fs::directory_iterator(home() / "data/jet/plugins/.staging", ignored))
            if (entry.path().filename() != "lock") names.push_back(entry.path().filename());
        return names;
    }
};

TEST_F(PackagesTest, PackingTwiceGivesTheSameBytes)
{
    const std::string folder = built("org.acme.rope");
    EXPECT_THAT(plain("plugins pack '" + folder + "'").out,
                HasSubstr("packed org.acme.rope 1.0.0: org.acme.rope-1.0.0.jetplugin"));
    fs::last_write_time(folder + "/plugin.json", fs::file_time_type::clock::now() - std::chrono::hours(1000));
    const auto second = json(plain("plugins pack '" + folder + "' again.jetplugin --json").out);
    EXPECT_EQ(read("again.jetplugin"), read("org.acme.rope-1.0.0.jetplugin"));
    EXPECT_EQ(second["id"], "org.acme.rope");
    EXPECT_EQ(second["sha256"].get<std::string>().size(), 64u);
}

TEST_F(PackagesTest, ASourceFolderIsNotPackedAndTheWayIsTold)
{
    const Outcome source = plain("plugins pack '" JET_SOURCE_DIR "/tests/fixtures/plugins/good' out.jetplugin");
    EXPECT_EQ(source.code, 1);
    EXPECT_THAT(source.err, HasSubstr("this is a source folder. Build it (cmake -B build"));
    EXPECT_FALSE(exists("out.jetplugin"));
    write("empty/readme", "x");
    EXPECT_THAT(plain("plugins pack empty").err, HasSubstr("has no plugin.json"));
    fs::create_symlink("/etc/passwd", built("org.acme.linked") + "/link");
    EXPECT_THAT(plain("plugins pack built/org.acme.linked1.0.0").err, HasSubstr("link: error: is a symbolic link"));
}

TEST_F(PackagesTest, AnInstalledPluginRunsAndRemovingItTakesItAway)
{
    const Outcome done = plain("plugins install " + packed("org.acme.rope"));
    EXPECT_EQ(done.code, 0) << done.err;
    EXPECT_THAT(done.out, HasSubstr("installed org.acme.rope 1.0.0 in "));
    EXPECT_THAT(plain("plugins info org.acme.rope").out, HasSubstr("state    loaded"));
    EXPECT_TRUE(leftovers().empty());
    const Outcome removed = plain("plugins remove org.acme.rope");
    EXPECT_EQ(removed.code, 0) << removed.err;
    EXPECT_EQ(version("org.acme.rope"), "");
    EXPECT_EQ(plain("plugins info org.acme.rope").code, 1);
    EXPECT_TRUE(leftovers().empty());
}

TEST_F(PackagesTest, AnUpdateReplacesAndKeepsSettingsAndADowngradeWantsForce)
{
    ASSERT_EQ(plain("plugins install " + packed("org.acme.rope", "1.1.0")).code, 0);
    ASSERT_EQ(plain("plugins disable org.acme.rope").code, 0);
    const auto update = json(plain("plugins install --json " + packed("org.acme.rope", "1.2.0")).out);
    EXPECT_EQ(update["installed"][0]["before"], "1.1.0");
    EXPECT_THAT(update["installed"][0]["notes"][0].get<std::string>(), HasSubstr("switched off"));
    EXPECT_EQ(version("org.acme.rope"), "1.2.0");
    EXPECT_EQ(read("config/jet/disabled-plugins"), "org.acme.rope\n");

    const std::string old = packed("org.acme.rope", "1.0.0");
    const Outcome refused = plain("plugins install " + old);
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.err, HasSubstr("the newer version 1.2.0 is installed; --force takes the older one"));
    EXPECT_EQ(version("org.acme.rope"), "1.2.0");
    EXPECT_EQ(plain("plugins install --force " + old).code, 0);
    EXPECT_EQ(version("org.acme.rope"), "1.0.0");

    write("config/jet/settings/org.acme.rope.json", R"({ "rope": { "slack": "0.2" } })");
    EXPECT_EQ(plain("plugins remove org.acme.rope").code, 0);
    EXPECT_EQ(read("config/jet/disabled-plugins"), "org.acme.rope\n");
    EXPECT_TRUE(exists("config/jet/settings/org.acme.rope.json"));
    ASSERT_EQ(plain("plugins install " + old).code, 0);
    EXPECT_EQ(plain("plugins remove --purge org.acme.rope").code, 0);
    EXPECT_EQ(read("config/jet/disabled-plugins"), "");
    EXPECT_FALSE(exists("config/jet/settings/org.acme.rope.json")) << "values of its settings pages";
}

TEST_F(PackagesTest, WhatIsRequiredMustBeThereAndWhoRequiresItIsNamed)
{
    const std::string top = packed("org.acme.top", "1.0.0", {"org.acme.base 1.1", "org.acme.other"});
    const Outcome refused = plain("plugins install " + top);
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.err, HasSubstr("requires org.acme.base 1.1 is not installed; org.acme.other is not installed"));
    EXPECT_EQ(version("org.acme.top"), "");
    ASSERT_EQ(plain("plugins install " + packed("org.acme.base", "1.0.0")).code, 0);
    ASSERT_EQ(plain("plugins install " + packed("org.acme.other")).code, 0);
    EXPECT_THAT(plain("plugins install " + top).err, HasSubstr("version 1.0.0 is installed and does not do"));
    ASSERT_EQ(plain("plugins install " + packed("org.acme.base", "1.3.0")).code, 0);
    ASSERT_EQ(plain("plugins install " + top).code, 0);

    const Outcome needed = plain("plugins remove org.acme.base");
    EXPECT_EQ(needed.code, 1);
    EXPECT_THAT(needed.err, HasSubstr("is required by org.acme.top; remove these first, or add --force"));
    EXPECT_EQ(version("org.acme.base"), "1.3.0");
    EXPECT_EQ(plain("plugins remove --force org.acme.base").code, 0);
    EXPECT_EQ(version("org.acme.base"), "");
}

TEST_F(PackagesTest, ALibraryThatDoesNotLoadIsNotInstalled)
{
    const Outcome text = plain("plugins install " + packed("org.acme.text", "1.0.0", {}, "not a library"));
    EXPECT_EQ(text.code, 1);
    EXPECT_THAT(text.err, HasSubstr("is no shared library; build or install the plugin again"));
    const std::pair<const char*, const char*> fixtures[] = {
        {"throws-on-load", "it fails while registering: no licence found"},
        {"undeclared", "effect 'surprise' is registered but not declared"},
        {"no-symbol", "has no symbol jet_plugin_entry"},
        {"wrong-entry", "was built for SDK 99.7"}};
    for (const auto& [name, reason] : fixtures) {
        const std::string id = std::string("org.jet.test.") + name;
        ASSERT_EQ(plain("plugins pack '" + (fixtureFolder() / id).string() + "' x.jetplugin").code, 0);
        const Outcome refused = plain("plugins install x.jetplugin");
        EXPECT_EQ(refused.code, 1) << name;
        EXPECT_THAT(refused.err, HasSubstr(reason));
        EXPECT_EQ(version(id), "");
    }
    EXPECT_TRUE(leftovers().empty());
}

TEST_F(PackagesTest, AnInterruptedInstallationIsInvisibleAndClearedAway)
{
    write("data/jet/plugins/.staging/7/plugin.json", R"({ "id": "org.acme.half" })");
    EXPECT_THAT(plain("plugins list").out, Not(HasSubstr("half")));
    ASSERT_EQ(plain("plugins install " + packed("org.acme.rope")).code, 0);
    EXPECT_TRUE(leftovers().empty());
}

TEST_F(PackagesTest, ADiskThatIsFullOrNoFolderLeavesTheOldVersion)
{
    ASSERT_EQ(plain("plugins install " + packed("org.acme.rope", "1.0.0")).code, 0);
    const std::string update = packed("org.acme.rope", "2.0.0");
    // Files may not grow beyond 4 kB: the library cannot be written.
    const Outcome full = plain("plugins install " + update, "sh -c 'ulimit -f 8; exec \"$@\"' sh");
    EXPECT_EQ(full.code, 1);
    EXPECT_THAT(full.err, HasSubstr("cannot be written: File too large; free some space"));
    EXPECT_EQ(version("org.acme.rope"), "1.0.0");
    EXPECT_TRUE(leftovers().empty());
    write("a-file", "x");
    const Outcome nowhere = plain("plugins install " + update, "XDG_DATA_HOME=" + file("a-file"));
    EXPECT_EQ(nowhere.code, 1);
    EXPECT_THAT(nowhere.err, HasSubstr("the folder cannot be made: Not a directory"));
    const Outcome unwritable = plain("plugins install " + update, "XDG_DATA_HOME=/proc");
    EXPECT_EQ(unwritable.code, 1);
    EXPECT_THAT(unwritable.err, HasSubstr("the folder cannot be made"));
}

TEST_F(PackagesTest, WrongCallsAreToldFromFailedWork)
{
    EXPECT_EQ(plain("plugins install").code, 2);
    EXPECT_EQ(plain("plugins search rope").code, 2);
    const Outcome id = plain("plugins install org.acme.rope");
    EXPECT_EQ(id.code, 2);
    EXPECT_THAT(id.err, HasSubstr("--from URL-or-DIR"));
    EXPECT_EQ(plain("plugins install none.jetplugin").code, 1);
    EXPECT_EQ(plain("plugins remove org.acme.rope").code, 1);
    EXPECT_THAT(plain("plugins remove org.jet.tool.selection").err,
                HasSubstr("was not installed by you; 'jet plugins disable"));
    const Outcome said = plain("plugins install none.jetplugin --json");
    EXPECT_EQ(json(said.out)["ok"], false);
}

class RepositoryCommandTest : public PackagesTest {
protected:
    RepositoryCommandTest()
    {
        packed("org.acme.base", "1.0.0");
        packed("org.acme.base", "1.4.0");
        packed("org.acme.top", "1.0.0", {"org.acme.base 1.2"});
        index();
    }
    void index()
    {
        const Outcome made = plain("plugins index repo");
        EXPECT_EQ(made.code, 0) << made.err;
    }
};

TEST_F(RepositoryCommandTest, AFolderIsARepository)
{
    const auto found = json(plain("plugins search TOP --from repo --json").out);
    ASSERT_EQ(found["plugins"].size(), 1u);
    EXPECT_EQ(found["plugins"][0]["id"], "org.acme.top");
    EXPECT_EQ(found["plugins"][0]["fits"], true);
    EXPECT_EQ(lines(plain("plugins search --from repo").out), 2u);
    const Outcome done = plain("plugins install org.acme.top --from repo");
    EXPECT_EQ(done.code, 0) << done.err;
    EXPECT_EQ(version("org.acme.base"), "1.4.0");
    EXPECT_EQ(version("org.acme.top"), "1.0.0");
}

TEST_F(RepositoryCommandTest, TheIndexHasTheSameBytesEachTime)
{
    const std::string first = read("repo/index.json");
    index();
    EXPECT_EQ(read("repo/index.json"), first);
    write("repo/broken.jetplugin", "x");
    const Outcome broken = plain("plugins index repo");
    EXPECT_EQ(broken.code, 1);
    EXPECT_THAT(broken.err, HasSubstr("broken.jetplugin: error: this is no package"));
    EXPECT_EQ(read("repo/index.json"), first);
}

TEST_F(RepositoryCommandTest, AWebServerIsARepository)
{
    const Server server(home() / "repo");
    ASSERT_GT(server.port(), 0) << "python3 is needed for this test";
    const Outcome done = plain("plugins install org.acme.top --from " + server.address());
    EXPECT_EQ(done.code, 0) << done.err;
    EXPECT_EQ(version("org.acme.base"), "1.4.0");
    EXPECT_EQ(version("org.acme.top"), "1.0.0");
    fs::remove(home() / "repo/org.acme.top-1.0.0.jetplugin");
    EXPECT_THAT(plain("plugins install org.acme.top --from " + server.address() + "/").err,
                HasSubstr("cannot be downloaded: the server has no such file"));
    EXPECT_THAT(plain("plugins search --from " + server.address() + "/nothing").err, HasSubstr("has an index.json"));
}

TEST_F(RepositoryCommandTest, WithoutCurlOrServerTheReasonIsTold)
{
    fs::create_directories(home() / "no-programs");
    const Outcome none = plain("plugins search --from http://127.0.0.1:1", "PATH=" + file("no-programs"));
    EXPECT_EQ(none.code, 1);
    EXPECT_THAT(none.err, HasSubstr("the program curl is needed, and it is not installed"));
    EXPECT_THAT(plain("plugins search --from http://127.0.0.1:1").err, HasSubstr("the host does not answer"));
}

TEST_F(RepositoryCommandTest, WhatIsNotWhatTheIndexSaysIsNotInstalled)
{
    const std::string name = "repo/org.acme.base-1.4.0.jetplugin", whole = read(name);
    std::string flipped = whole;
    flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
    write(name, flipped);
    const Outcome wrong = plain("plugins install org.acme.top --from repo");
    EXPECT_EQ(wrong.code, 1);
    EXPECT_THAT(wrong.err, HasSubstr("is not the one of the index: its SHA-256 is"));
    write(name, whole.substr(0, whole.size() / 2));
    EXPECT_THAT(plain("plugins install org.acme.top --from repo").err, HasSubstr("the download is not complete"));
    // Nothing of what belongs together was put in place.
    EXPECT_EQ(version("org.acme.base"), "");
    EXPECT_EQ(version("org.acme.top"), "");
    EXPECT_TRUE(leftovers().empty());
    write("repo/index.json", read("repo/index.json").substr(0, 100));
    EXPECT_THAT(plain("plugins install org.acme.top --from repo").err, HasSubstr("index.json:"));
}

}  // namespace
}  // namespace jet::test
