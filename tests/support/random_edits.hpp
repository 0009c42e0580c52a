// A person who edits at random: every kind of change, undo and redo, changes of the tree of scenes. The same seed and
// the same project give the same edits.
#pragma once

#include <jet/editor.hpp>
#include <jet/project.hpp>

#include <random>

namespace jet::test {

class RandomEdits {
public:
    RandomEdits(Project& project, EventsCenter& events, std::uint64_t seed)
        : project_(project), events_(events), random_(seed)
    {
    }

    /// One step: an edit, an undo, a redo or a change of the tree. A step that JET refuses changes nothing.
    void step()
    {
        const std::size_t kind = below(100);
        try {
            if (kind < 4) return changeTree();
            if (project_.scenes().empty()) return addScene();
            Scene& scene = *project_.scenes()[below(project_.scenes().size())];
            if (kind < 18) return scene.undoRedo().undo();
            if (kind < 26) return scene.undoRedo().redo();
            edit(scene);
        } catch (const Failure&) {
            // Moving a group into itself and the like.
        }
    }
    std::size_t below(std::size_t limit) { return limit == 0 ? 0 : static_cast<std::size_t>(random_() % limit); }

private:
    void addScene()
    {
        project_.addScene(project_.freeSceneName());
        events_.post(this, ProjectChanged{});
    }
    void changeTree()
    {
        const auto scenes = project_.scenes();
        switch (below(4)) {
        case 0: project_.setName("Name " + std::to_string(below(100))); break;
        case 1:
            if (!scenes.empty()) scenes[below(scenes.size())]->setName("Level " + std::to_string(random_()));
            break;
        case 2:
            if (scenes.size() > 4) project_.removeScene(*scenes[below(scenes.size())]);
            break;
        default: project_.addScene(project_.freeSceneName()); break;
        }
        events_.post(this, ProjectChanged{});
    }

    void edit(Scene& scene)
    {
        auto edit = scene.items().begin("Edit");
        for (std::size_t n = 1 + below(6); n > 0; --n) {
            try {
                change(edit, scene);
            } catch (const Failure&) {
                // one change less
            }
        }
        edit.commit(below(4) == 0 ? "drag" : "");
    }

    double number() { return static_cast<double>(static_cast<std::int64_t>(random_() % 2'000'001) - 1'000'000) / 997; }
    Path path()
    {
        if (below(5) == 0) return {};
        Path path = below(2) == 0 ? Path::rectangle(Box({number(), number()}, {number(), number()}))
                                  : Path::line({number(), number()}, {number(), number()});
        path.setIntermediate(static_cast<int>(below(4)));
        return path;
    }
    std::string word() { return std::string(1 + below(3), static_cast<char>('a' + below(26))) + "<&\"\n é"; }

    const Item& any(const Scene& scene)
    {
        std::vector<const Item*> all;
        scene.root().walk([&](const Item& item) { all.push_back(&item); });
        return *all[below(all.size())];
    }
    const Item& container(const Scene& scene)
    {
        std::vector<const Item*> all;
        scene.root().walk([&](const Item& item) {
            if (item.isContainer()) all.push_back(&item);
        });
        return *all[below(all.size())];
    }

    void change(Transaction& edit, const Scene& scene)
    {
        static constexpr std::string_view types[] = {"shape", "group", "layer", "body", "spring", "script", "rope"};
        const Item& item = any(scene);
        const std::size_t kind = below(20);
        const bool large = scene.items().itemCount() > 300;
        if (kind < 5 && !large) {
            edit.add(types[below(std::size(types))], container(scene), path(), below(5));
        } else if (kind == 5 && !large) {
            edit.addCopy(item, container(scene), below(5));
        } else if (kind < 7 || (kind < 10 && large)) {
            edit.remove(item);
        } else if (kind < 10) {
            edit.move(item, container(scene), below(6));
        } else if (kind == 10) {
            setCommon(edit, item);
        } else if (kind == 11) {
            edit.setPath(item, path());
        } else if (kind == 12) {
            edit.transform(item, Affine::translation({number(), number()}));
        } else if (kind == 13) {
            edit.setType(item, types[below(std::size(types))]);
        } else if (kind < 17) {
            changeEffect(edit, item);
        } else if (kind == 17) {
            setProperty(edit, scene, item);
        } else if (kind == 18) {
            edit.setScene("gravity", Vec2(number(), number()));
        } else {
            MaterialTable table = scene.materials();
            if (table.size() < 5) table.add("m" + std::to_string(random_()));
            table.setPair(0, table.size() - 1, {std::abs(number()), 0.5, below(2) == 0});
            edit.setMaterials(table);
        }
    }

    void setCommon(Transaction& edit, const Item& item)
    {
        switch (below(3)) {
        case 0: return edit.set(item, "name", word());
        case 1: return edit.set(item, "visible", below(2) == 0);
        default: return edit.set(item, "locked", below(2) == 0);
        }
    }
    void setProperty(Transaction& edit, const Scene& scene, const Item& item)
    {
        if (item.type() == "rope") return edit.set(item, "target", any(scene).id());
        if (item.type() == "script") return edit.set(item, "code", word());
        if (item.type() == "body") return edit.set(item, "velocity", Vec2(number(), number()));
        edit.set(item, "ks", std::abs(number()));
    }
    void changeEffect(Transaction& edit, const Item& item)
    {
        const std::size_t count = item.effects().size();
        const std::size_t at = below(count);
        switch (count == 0 ? 0 : below(5)) {
        case 0: edit.addEffect(item, below(2) == 0 ? "tint" : "box-body"); break;
        case 1: edit.removeEffect(item, at); break;
        case 2: edit.moveEffect(item, at, below(count)); break;
        case 3: edit.setEffect(item, at, "visible", below(2) == 0); break;
        default: edit.setEffect(item, at, "note", word()); break;
        }
    }

    Project& project_;
    EventsCenter& events_;
    std::mt19937_64 random_;
};

}  // namespace jet::test
