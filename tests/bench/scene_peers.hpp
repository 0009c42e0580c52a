// What the scene is measured against: Qt's graphics scene and undo stack, pugixml's parser.
#pragma once

#include <memory>
#include <string>

namespace jet::bench {

/// A copy of the text, parsed in place with the options JET uses; nothing is done with the tree.
void parseWithPugixml(const std::string& text);

/// A QGraphicsScene of rectangles and ellipses, placed as the benchmark's scene is, and a QUndoStack.
class QtPeer {
public:
    static QtPeer& get(int shapes, int columns, double pitch);

    void hit(double x, double y);
    /// Items wholly inside.
    void inside(double x, double y, double width, double height);
    void moveFirst(int count, double dx, double dy);
    /// A command that keeps the old and the new places, as JET's history does.
    void pushMove(int count, double dx, double dy);
    void undoOrRedo();

private:
    QtPeer(int shapes, int columns, double pitch);
    ~QtPeer() = default;
    struct Private;
    std::unique_ptr<Private> d_;
};

}  // namespace jet::bench
