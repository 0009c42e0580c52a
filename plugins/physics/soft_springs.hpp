// Springs and angular springs inside soft bodies (thesis §2.4.3.2, §2.4.3.3).
//
// Order of calls: add each body -> addTo the bounds -> prepare for a substep length -> addForces, accelerate and
// applyAngular, each substep.
//
// Springs are forces of the state a substep starts from, 8 at a time (soft/kernels.hpp, soft/batch.hpp), so their order
// does not matter. Why no stiffness and no damping explodes stands in stiffness.hpp. The damping constant of a substep
// is (1 - exp(-h kd w)) / (h w), w = 1/m + 1/m: the amplitude of a single spring then decays exactly as exp(-kd w t /
// 2). Fully implicit springs were an alternative: stable at any stiffness too, but they damp what the author asked to
// swing.
#pragma once

#include "soft/batch.hpp"
#include "soft/kernels.hpp"
#include "state.hpp"
#include "stiffness.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace jet::physics {

class SoftSprings {
public:
    Index springCount() const { return static_cast<Index>(a_.size()); }
    Index angularCount() const { return static_cast<Index>(angular_.size()); }

    /// The springs of a new body go where its record says: behind all others, or where those of a removed one were.
    /// `nodeOf`: particle -> node of the world.
    void add(const State&, const SoftBodyDef&, BodyHandle, std::span<const Index> nodeOf);

    /// `loose`: nothing but these springs acts on soft bodies, so their nodes may be weighed.
    void addTo(StiffnessBounds&, const State&, bool loose);
    /// Substeps a second at which the body's springs may act as they are.
    double stableRate(const StiffnessBounds&, const BodyRecord&, Index body) const;
    /// Substeps a second at which they swing in time.
    double swingRate(const StiffnessBounds&, const BodyRecord&, Index body) const;
    WideSwing wideSwing(const StiffnessBounds&, const BodyRecord&, Index body) const;
    /// Fixes what depends on the length of a substep.
    /// `plain`: stiffness and damping as they are, whatever comes of it.
    void prepare(const State&, const StiffnessBounds&, double h, bool plain = false);

    /// Replaces the stiffness, damping and tear ratio of all springs of the body, until it is restored to before.
    void set(Index body, double ks, double kd, double tearRatio);
    /// Would that change nothing?
    bool isSet(Index body, double ks, double kd, double tearRatio) const
    {
        const Mesh& mesh = meshes_[body];
        return mesh.uniform && mesh.ks == ks && mesh.kd == kd && mesh.tearRatio == std::max(tearRatio, 0.0);
    }
    /// What the spring pulls with as the nodes are, in single springs' own stiffness; 0 when torn.
    double tension(const State&, Index body, Index spring) const;
    /// What the springs and angular springs of a soft body hold, torn ones nothing: ½ ks e e', e the strain now, e'
    /// before the last move over h.
    double energy(const State&, Index body, double h) const;
    /// What says how slowly a body may move by itself.
    struct Slowest {
        double ks = std::numeric_limits<double>::infinity();    // least of its springs, force / unit
        double fade = std::numeric_limits<double>::infinity();  // least ks / kd, 1 / s, as far as substeps bear them:
                                                                // how fast what is damped comes to rest
    };
    Slowest slowest(Index body) const;
    /// Does plasticity change the body as it is?
    bool flows(const State&, Index body) const;
    /// Plasticity: lets springs that are strained beyond the yield of their body flow, over a step of dt
    /// whose substeps take h.
    void flow(const State&, double dt, double h);

    void use(const soft::Kernels& kernels) { kernels_ = &kernels; }
    const soft::Kernels& kernels() const { return *kernels_; }

    /// Adds the forces of springs computed in double, one by one, to those on the nodes.
    void addForces(State&);
    /// The others: changes the velocities of their bodies over h, by springs, gravity and damping (`kept`: the part it
    /// leaves), and by the forces on the nodes where there are any (`pushed`); those are used up.
    void accelerate(State&, double h, const Vec2& gravity, double kept, bool pushed);
    /// Moves a body's nodes on over h, at the velocities they have.
    void advance(State&, Index body, double h) const;
    /// Moves the body on over `count` substeps of h, as accelerate() and advance() would; nothing else may act on it
    /// meanwhile (soft/flight.hpp). `most`: units its particles may go astray of uniform motion. False, and nothing has
    /// changed, where that cannot be done at once.
    bool fly(State&, Index body, double h, int count, const Vec2& gravity, double kept, double most);
    /// May the body be of those fly() can move?
    bool mayFly(Index body) const
    {
        return body < meshes_.size() && meshes_[body].wide && batches_[meshes_[body].batch].flies();
    }
    bool anyOneByOne() const { return anyOneByOne_; }
    /// Is the body one of those that accelerate() moves?
    bool isWide(Index body) const { return meshes_[body].wide; }
    /// Changes velocities by the impulses of angular springs over h. `backwards` alternates, so that no end of the list
    /// is favoured.
    void applyAngular(State&, double h, bool backwards);

    /// The same as forces of the state as it is, for Method::SemiImplicitEuler.
    void addAngularForces(State&);

    void remove(Index body);

    bool alive(Index spring) const { return alive_[spring] != 0; }
    /// Springs from a particle to itself never were whole, and never tear.
    bool anyTorn(Index body) const { return tornCount(body) > 0; }
    Index tornCount(Index body) const { return body < torn_.size() ? torn_[body] : 0; }
    bool anyTorn() const { return anyTorn_; }
    // Nodes a spring joins.
    Index endA(Index spring) const { return a_[spring]; }
    Index endB(Index spring) const { return b_[spring]; }

    template <class Archive>
    void archive(Archive& with)
    {
        with(alive_);
        for (Mesh& mesh : meshes_) with(mesh.uniform), with(mesh.ks), with(mesh.kd), with(mesh.tearRatio);
        auto flowed = static_cast<std::uint8_t>(!drawn_.empty());
        with(flowed);
        if (flowed != 0) {
            if (drawn_.empty()) drawn_ = rest_;
            with(rest_);
        } else if (!drawn_.empty()) {
            rest_ = std::exchange(drawn_, {});
        }
        for (Angular& spring : angular_) with(spring.angle);
    }
    /// After alive_ was read back.
    void restored();

private:
    struct Angular {
        Index a = kNone, centre = kNone, b = kNone;  // kNone: its body was removed
        double restAngle = 0, ks = 0, kd = 0;
        double angle = 0;           // unwrapped: continues through ±pi
        double restCompliance = 0;  // sum of |grad angle|² / m at rest
        Index body = kNone;
        double stiffness = 0;  // ks after softening
        double damping = 0;    // kd and what softening adds
    };
    struct Corner;
    struct Kind {
        double ks = 0, kd = 0;
        double tearRatio = 0;  // times the rest length as drawn; 0: never
    };
    /// Springs of one body.
    struct Mesh {
        Range nodes, springs;
        bool wide = false;  // computed by the kernels, not in double, one by one
        Index batch = 0, lane = 0;
        soft::Topology topology;
        std::vector<float> bias;                 // [springs] what single lengths differ by from true ones, as added
        std::vector<double> stiffness, damping;  // [springs] for the prepared h, where they are computed one by one
        bool tears = false;
        bool uniform = false;  // ks, kd and tearRatio stand for those of all its springs
        double ks = 0, kd = 0, tearRatio = 0;
        double fastestAtRest = 0;  // rad / s, of vast bodies; 0: not known
        double provenRate = 0;     // substeps / s that were proven to suffice, besides the bounds; 0: none
        double fade = std::numeric_limits<double>::infinity();  // as of Slowest, in the prepared substep
    };

    void addAngular(const State&, const AngularSpringDef&, std::span<const Index> nodeOf, Index body, Index place);
    void dropUnusedKinds();
    double stiffnessOf(const Mesh& mesh, Index i) const { return mesh.uniform ? mesh.ks : kindOf(i).ks; }
    double dampingOf(const Mesh& mesh, Index i) const { return mesh.uniform ? mesh.kd : kindOf(i).kd; }
    /// Length at which the spring tears; 0: never.
    double tearLength(const Mesh& mesh, Index i) const
    {
        return (mesh.uniform ? mesh.tearRatio : kindOf(i).tearRatio) * (drawn_.empty() ? rest_[i] : drawn_[i]);
    }
    const Kind& kindOf(Index i) const { return kinds_[kind_[i]]; }
    Index kindLike(const SpringDef&);
    void addTo(StiffnessBounds&, const State&, const Mesh&) const;
    void weigh(StiffnessBounds&, const State&, const Mesh&);
    double fastestAtRest(const StiffnessBounds&, const State&, const Mesh&, Index body);
    double provenRate(const State&, const Mesh&, double rate);
    bool isStable(const State&, const Mesh&, double h);
    void arrange(const State&);
    void watchTears(soft::Batch&);
    void prepareMesh(const State&, const StiffnessBounds&, Mesh&, const BodyRecord&, double h);
    void measureBias(const State&, Mesh&);
    void fill(Mesh&);
    void fillRests(const Mesh&);
    /// Of the part at work of a body.
    struct Room {
        std::vector<float> planes, held, spilt, ring;
        std::vector<std::uint32_t> torn;
    };
    void accelerateAlone(State&, soft::Batch&, soft::VelocityStep, double* force);
    soft::Swing swing(const State&, soft::Batch&, const soft::NodeArrays&, const soft::VelocityStep&);
    void accelerateAlike(State&, soft::Batch&, double h, const Vec2& gravity, double kept, double* force);
    soft::Frame frameOf(const State&, Index body) const;
    soft::SpringBlocks springsOf(const soft::Batch&, Room&) const;
    soft::Stretch partOf(const soft::Batch&, std::size_t part);
    void makeFlightRoom();
    static soft::Planes planes(const soft::Batch&, Room&);
    void pullOneByOne(State&, Mesh&);
    void tearIn(const State&, const soft::Batch&, std::span<std::uint32_t> blocks);
    void tear(Mesh&, Index spring);
    Index bodyOf(const soft::Batch&, Index lane) const;
    void applyAngularSpring(State&, Angular&, double h);
    static double energy(const State&, const Angular&, double h);

    const soft::Kernels* kernels_ = &soft::kernelsFor(Simd::Automatic);
    std::vector<Index> a_, b_;  // nodes
    std::vector<double> rest_;
    std::vector<Index> kind_;  // into kinds_: most springs of a body are alike
    std::vector<Kind> kinds_;
    std::vector<double> drawn_;  // rest lengths before any flow; empty: none flowed
    std::vector<std::uint8_t> alive_;
    std::vector<Mesh> meshes_;  // [bodies]; rigid ones have no springs
    std::vector<soft::Batch> batches_;
    bool arranged_ = false;  // do the batches hold all bodies?
    bool anyOneByOne_ = false;
    bool anyTorn_ = false;
    std::vector<Index> torn_;  // [bodies] number of torn springs
    std::vector<Angular> angular_;
    Index turning_ = 0;  // of them, those of bodies there are
    double crush_ = 0;   // seconds: crushed springs are damped by so much of their stiffness (soft::kCrushed)
    // Scratch of the body or batch at work; that of preparing is given back.
    std::vector<Vec2> drift_;  // [bodies] units / s, of the substep
    std::vector<Room> rooms_;  // the first serves what is not divided
    std::vector<float> flight_;
    std::vector<double> stiffness_, damping_, load_, weight_, matrix_;
};

}  // namespace jet::physics
