// Panel: a dock widget a plugin brings. The interface itself needs no Qt header; the plugin includes what it uses.
#pragma once

#include <jet/editor.hpp>

class QWidget;

namespace jet {

/// One panel. Created when first shown, destroyed with the window. [GUI thread]
class JET_API Panel {
public:
    explicit Panel(Editor& editor) : editor_(editor) {}
    virtual ~Panel();

    /// Called once; the caller becomes the widget's parent and owner.
    virtual QWidget* createWidget() = 0;

protected:
    Editor& editor() const { return editor_; }

private:
    Editor& editor_;
};

}  // namespace jet
