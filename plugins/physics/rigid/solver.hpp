// Contacts and joints of rigid bodies as wide constraints: begin -> add... -> then either run() for a whole step, or
// push() and relax() around position changes made elsewhere -> finish.
#pragma once

#include "contact.hpp"
#include "joint.hpp"
#include "solver_data.hpp"

#include <vector>

namespace jet::physics {

struct StepShape {
    double h = 0;  // seconds a substep
    int substeps = 1;
    int passes = 1;        // over all constraints; more when something is hit hard
    double restSpeed = 0;  // units / s
    KernelChoice choice = KernelChoice::Best;
};

template <class Real>
class Solver {
public:
    /// Forgets all constraints; bodies are to be set by body() and push().
    void begin(std::size_t bodies, const StepShape&);
    BodyState<Real>& body(Index i) { return states_[i]; }
    BodyPush<Real>& force(Index i) { return pushes_[i]; }

    void addContact(RigidContact&, Index index, const RigidBody& a, const RigidBody& b, const Pose&, const Pose&);
    void addJoint(Joint&, Index index, const State&, const std::vector<RigidBody>&);

    /// A whole step: velocities and moves of all bodies.
    void run();

    // One substep at a time, for worlds in which other stages move the same bodies between.
    void warm();
    void push();
    void relax();
    void bounce();

    /// Gives the impulses back to those they came from.
    void finish(std::vector<RigidContact>&, std::vector<Joint>&);

    std::size_t colours() const { return used_; }
    std::size_t bytes() const;

private:
    struct Colour {
        std::vector<ContactLanes<Real>> contacts;
        std::vector<FrictionLanes<Real>> frictions;
        std::vector<BounceLanes<Real>> bounces;
        std::vector<Index> index;  // [lanes] of the contact
        std::size_t count = 0;     // lanes in use
    };
    struct JointColour {
        std::vector<JointLanes<Real>> joints;
        std::vector<Index> index;
        std::size_t count = 0;
    };

    static constexpr int kColours = 24;  // more are solved one by one, in the last

    int colourOf(Index a, Index b, std::vector<std::uint32_t>& taken);
    std::size_t laneOf(Colour&, bool alone);
    void warmAll();
    void solveAll(bool push);
    void noteAll();
    static std::size_t groups(std::size_t lanes) { return (lanes + kLanes<Real> - 1) / kLanes<Real>; }

    StepShape shape_;
    StepConstants<Real> constants_;
    const Kernels<Real>* kernels_ = nullptr;
    std::vector<BodyState<Real>> states_;
    std::vector<BodyPush<Real>> pushes_;
    std::vector<std::uint32_t> taken_, takenByJoints_;  // [bodies] colours
    std::vector<Colour> colours_;
    std::vector<JointColour> jointColours_;
    std::vector<JointRow<Real>> rows_;
    std::size_t used_ = 0;
    bool bounces_ = false;
};

extern template class Solver<float>;
extern template class Solver<double>;

}  // namespace jet::physics
