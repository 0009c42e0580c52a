// The files of a project, what is wrong with them, and what they would be if that were mended. Writes nothing.
#pragma once

#include "xml_file.hpp"

#include <jet/project.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace jet::host {

class ProjectMender {
public:
    ProjectMender(std::filesystem::path file, EventsCenter& events, Catalog& catalog);

    /// Reads and looks at everything.
    Result<void> run();

    const Findings& findings() const { return findings_; }
    /// Would the mended project open?
    bool opens() const { return opens_; }
    /// Texts as they were read, by path relative to the project's folder.
    const std::map<std::string, std::string>& originals() const { return originals_; }
    /// Is this file of today's version of the format? What is not, is read, but not mended.
    bool isCurrent(const std::string& name) const { return !older_.contains(name); }
    /// Those that the repair changes, scenes first, project.jet last.
    std::vector<std::pair<std::string, std::string>> changedFiles() const;
    /// Files that a process left unfinished when it ended.
    const std::vector<std::filesystem::path>& leftovers() const { return leftovers_; }

private:
    Result<void> readProject();
    void mendTree(pugi::xml_node root);
    void mendEntry(pugi::xml_node entry);
    void mendScene(const std::string& name);
    void addUnlisted(pugi::xml_node root);
    void mendStart(pugi::xml_node root);
    void findLeftovers();
    void tryToOpen();
    bool lacksProvides() const;
    std::optional<std::string> fromBackups(const std::string& name) const;
    void tell(Finding::Weight weight, Location where, std::string problem, std::string repair);
    std::string freeName(const std::string& name) const;

    std::filesystem::path file_, folder_;
    std::string name_;  ///< of the project file
    EventsCenter& events_;
    Catalog& catalog_;
    Findings findings_;
    std::map<std::string, std::string> originals_, mended_;
    std::unique_ptr<XmlFile> project_;
    std::set<std::string> sceneNames_, sceneFiles_, older_;
    std::vector<std::string> scenes_;  ///< files, in the order of the tree
    std::vector<std::filesystem::path> leftovers_;
    bool opens_ = false;
};

}  // namespace jet::host
