#include "simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>

#include "describe.h"
#include "live_world.h"

namespace cairn::view {

using nlohmann::json;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

namespace {

constexpr auto frame_interval = std::chrono::microseconds(15500);  // a little below 1/60 s, against missed pictures
constexpr auto state_interval = std::chrono::milliseconds(250);
constexpr auto selection_interval = std::chrono::milliseconds(80);
constexpr auto step_budget = std::chrono::milliseconds(12);  // between two looks at the commands
constexpr double most_debt = 0.1;    // simulated time that is caught up after a hitch, at speed 1 [s]
constexpr double rate_window = 0.5;  // [s]

SharedMessage textMessage(const json& object) {
    // Texts of users may hold broken UTF-8; it must not stop the answer.
    return std::make_shared<const Message>(
        Message{Message::Kind::text, object.dump(-1, ' ', false, json::error_handler_t::replace)});
}

/// How fast simulated time passes, measured over the last moments.
class RateMeter {
  public:
    void reset(Clock::time_point now, double simulated) {
        since_ = now;
        from_ = simulated;
        rate_ = 0;
    }
    void update(Clock::time_point now, double simulated) {
        const double passed = Seconds(now - since_).count();
        if (passed < rate_window) return;
        rate_ = (simulated - from_) / passed;
        since_ = now;
        from_ = simulated;
    }
    double rate() const { return rate_; }

  private:
    Clock::time_point since_;
    double from_ = 0;
    double rate_ = 0;
};

}  // namespace

struct Simulation::Impl {
    struct Joined {};
    struct Left {};
    struct Envelope {
        ClientId client;
        std::variant<Joined, Left, Command> content;
    };
    struct Viewer {
        Layers layers = bit(Layer::joints);  ///< the first picture shows how far they reach
        std::optional<BodyId> selected;
        bool selection_due = false;
        std::vector<Ray> rays;
    };

    Impl(const LiveOptions& options, Outbox& out)
        : outbox(out),
          world(options.scene, options.scene_name, settingsFor(options.scene, options.overrides)),
          begin_with_first_viewer(options.begin == LiveOptions::Begin::playing) {
        thread = std::thread([this] { run(); });
    }

    ~Impl() {
        {
            const std::lock_guard lock(mutex);
            ending = true;
        }
        wake.notify_one();
        thread.join();
    }

    void post(Envelope envelope) {
        {
            const std::lock_guard lock(mutex);
            inbox.push_back(std::move(envelope));
        }
        wake.notify_one();
    }

    // --- everything below belongs to the simulation's thread ---
    void run() {
        last_look = Clock::now();
        while (receive()) {
            advance();
            publish();
        }
    }

    /// Waits for commands as long as there is nothing to do, then carries them out. @return false at the end
    bool receive() {
        std::vector<Envelope> envelopes;
        {
            std::unique_lock lock(mutex);
            const auto ready = [this] { return ending || !inbox.empty(); };
            if (!ready()) wake.wait_for(lock, patience(), ready);
            if (ending) return false;
            envelopes.swap(inbox);
        }
        for (Envelope& envelope : envelopes) handle(envelope);
        return true;
    }

    /// How long the thread may sleep.
    Clock::duration patience() const {
        if (playing) {
            const double missing = world.world().settings().timeStep() - debt;
            const auto step = std::chrono::duration_cast<Clock::duration>(Seconds(std::max(0.0, missing) / speed));
            return std::min<Clock::duration>(step, frame_interval / 2);
        }
        if (steps_left > 0) return {};
        return dirty ? Clock::duration(frame_interval / 4) : Clock::duration(state_interval);
    }

    void handle(Envelope& envelope) {
        const ClientId client = envelope.client;
        if (std::holds_alternative<Joined>(envelope.content)) {
            welcome(client);
        } else if (std::holds_alternative<Left>(envelope.content)) {
            world.release(client);
            viewers.erase(client);
            state_due = true;
        } else if (viewers.contains(client)) {
            carryOut(client, std::get<Command>(envelope.content));
        }
    }

    void welcome(ClientId client) {
        viewers[client] = {};
        tellOfRoster();
        outbox.toOne(client, textMessage(world.describeWorld()));
        if (begin_with_first_viewer) setPlaying(true);
        begin_with_first_viewer = false;
        dirty = state_due = true;
    }

    void carryOut(ClientId client, const Command& command) {
        json answer = {{"type", "done"}};
        try {
            std::visit([&](const auto& action) { act(client, action, answer); }, command.action);
        } catch (const std::exception& error) {
            answer = {{"type", "error"}, {"text", error.what()}};
        }
        dirty = true;
        if (command.id) answer["id"] = *command.id;
        if (command.id || answer["type"] == "error") outbox.toOne(client, textMessage(answer));
    }

    void setPlaying(bool on) {
        playing = on;
        debt = 0;
        last_look = Clock::now();
        rate.reset(last_look, world.world().time());
        state_due = true;
    }

    void act(ClientId, const Play&, json&) { setPlaying(true); }
    void act(ClientId, const Pause&, json&) { setPlaying(false); }
    void act(ClientId, const Reset&, json&) {
        world.reset();
        begun();
    }
    void act(ClientId, const Step& step, json&) {
        setPlaying(false);
        steps_left += step.count;
    }
    void act(ClientId, const SetSpeed& set, json&) {
        speed = set.speed;
        rate.reset(Clock::now(), world.world().time());
        state_due = true;
    }
    void act(ClientId, const LoadBuiltIn& load, json&) {
        // Files of this machine are not a viewer's business: only names of built-in scenes are taken.
        if (!isBuiltInScene(load.name)) throw InputError(fmt::format("there is no built-in scene '{}'", load.name));
        world.load(builtInScene(load.name), load.name);
        begun();
    }
    void act(ClientId, const LoadText& load, json&) {
        world.load(parseScene(load.text, load.name), load.name);
        begun();
    }
    void act(ClientId, const SetDial& dial, json&) {
        world.setDial(dial.value);
        state_due = true;
    }
    void act(ClientId, const SetField& field, json&) {
        world.setField(field);
        state_due = true;
    }
    void act(ClientId, const ThrowBall& ball, json& answer) { tellBody(world.throwBall(ball), answer); }
    void act(ClientId, const AddBody& body, json& answer) { tellBody(world.add(body), answer); }
    void act(ClientId, const DeleteBody& body, json&) { world.remove(body.body); }
    void act(ClientId, const FreezeBody& freeze, json&) { world.freeze(freeze); }
    void act(ClientId client, const GrabBody& grab, json&) { world.grab(client, grab); }
    void act(ClientId client, const DragBody& drag, json&) { world.drag(client, drag); }
    void act(ClientId client, const ReleaseBody&, json&) { world.release(client); }
    void act(ClientId client, const SelectBody& select, json&) {
        if (select.body) world.world().pose(*select.body);  // throws for a stale id
        viewers[client].selected = select.body;
        viewers[client].selection_due = true;
    }
    void act(ClientId client, const ChooseLayers& choose, json&) { viewers[client].layers = choose.layers; }

    void act(ClientId client, const CastRays& cast, json&) { viewers[client].rays = cast.rays; }

    static void tellBody(BodyId id, json& answer) {
        answer["body"] = {{"slot", id.index}, {"generation", id.generation}};
    }

    /// After a scene began anew.
    void begun() {
        for (auto& [client, viewer] : viewers) viewer.selected.reset();
        steps_left = 0;
        samples.clear();
        debt = 0;
        rate.reset(Clock::now(), 0);
        outbox.toAll(textMessage(world.describeWorld()));
        dirty = state_due = true;
    }

    /// Steps as much as real time asks for, but looks at the commands again after a few milliseconds.
    void advance() {
        const Clock::time_point now = Clock::now();
        if (playing) {
            debt += Seconds(now - last_look).count() * speed;
            debt = std::min(debt, std::max(most_debt * speed, world.world().settings().timeStep()));
        }
        last_look = now;
        world.world().setTracing(tracingFor(layersWanted()));
        try {
            while (due()) {
                if (const auto sample = world.step()) samples.push_back(*sample);
                dirty = true;
                if (playing)
                    debt -= world.world().settings().timeStep();
                else
                    --steps_left;
                if (Clock::now() - now > step_budget) break;
            }
        } catch (const std::exception& error) {
            setPlaying(false);
            steps_left = 0;
            outbox.toAll(
                textMessage({{"type", "error"}, {"text", fmt::format("the simulation stopped: {}", error.what())}}));
        }
        rate.update(Clock::now(), world.world().time());
    }

    bool due() const { return playing ? debt >= world.world().settings().timeStep() : steps_left > 0; }

    Layers layersWanted() const {
        Layers layers = 0;
        for (const auto& [client, viewer] : viewers) layers |= viewer.layers;
        return layers;
    }

    std::vector<Ray> raysWanted() const {
        std::vector<Ray> rays;
        for (const auto& [client, viewer] : viewers) rays.insert(rays.end(), viewer.rays.begin(), viewer.rays.end());
        return rays;
    }

    void publish() {
        tellOfRoster();
        const Clock::time_point now = Clock::now();
        if (dirty && outbox.frameWanted() && now - last_frame >= frame_interval) {
            outbox.frame(makeFrameMessage(world.world(), world.bodies(), world.epoch(), layersWanted(),
                                          {world.springLines(), raysWanted()}));
            for (auto& [client, viewer] : viewers) viewer.selection_due = true;
            last_frame = now;
            dirty = false;
        }
        if (!samples.empty()) {
            outbox.toAll(makeSampleMessage(samples));
            samples.clear();
        }
        if (state_due || (playing && now - last_state >= state_interval) ||
            (finishedSteps() && now - last_state >= state_interval / 8)) {
            outbox.toAll(textMessage(describeState()));
            last_state = now;
            state_due = false;
            told_step = world.world().stepCount();
        }
        if (now - last_selection >= selection_interval) tellOfSelections(now);
    }

    /// Steps one by one came to their end and viewers do not know yet.
    bool finishedSteps() const { return !playing && steps_left == 0 && told_step != world.world().stepCount(); }

    void tellOfRoster() {
        const RosterChange change = world.updateRoster();
        if (change.added.empty() && change.removed.empty()) return;
        outbox.toAll(textMessage(world.describeChange(change)));
        dirty = true;
    }

    void tellOfSelections(Clock::time_point now) {
        for (auto& [client, viewer] : viewers) {
            if (!viewer.selected || !viewer.selection_due) continue;
            viewer.selection_due = false;
            last_selection = now;
            if (!world.world().contains(*viewer.selected)) {
                viewer.selected.reset();
                continue;
            }
            outbox.toOne(client, textMessage(world.describeSelection(*viewer.selected)));
        }
    }

    json describeState() const {
        const World& w = world.world();
        json faults = json::array();
        for (const FaultInfo& fault : w.faults()) {
            faults.push_back(fmt::format("body {} at step {}: {}", fault.body.index, fault.step, fault.what));
        }
        const std::optional<double> dial = world.dial();
        const bool resting = !playing && steps_left == 0;
        return {{"type", "state"},
                {"scene", world.title()},
                {"duration", world.duration()},
                {"playing", playing},
                {"speed", speed},
                {"time", w.time()},
                {"steps", w.stepCount()},
                {"realTime", rate.rate()},
                {"dial", dial ? json(*dial) : json(nullptr)},
                {"settings", describeSettings(w.settings())},
                {"gravity", toJson(w.gravity())},
                {"clients", viewers.size()},
                {"hash", resting ? json(fmt::format("{:016x}", w.stateHash())) : json(nullptr)},
                {"kinetic", w.kineticEnergy()},
                {"potential", w.potentialEnergy()},
                {"faults", std::move(faults)}};
    }

    Outbox& outbox;
    std::mutex mutex;
    std::condition_variable wake;
    std::vector<Envelope> inbox;  ///< guarded by mutex
    bool ending = false;          ///< guarded by mutex

    LiveWorld world;
    std::map<ClientId, Viewer> viewers;
    bool begin_with_first_viewer;
    bool playing = false;
    double speed = 1;
    double debt = 0;  ///< simulated time that real time is ahead [s]
    std::int64_t steps_left = 0;
    std::int64_t told_step = 0;
    bool dirty = true;
    bool state_due = true;
    std::vector<Sample> samples;
    RateMeter rate;
    Clock::time_point last_look, last_frame, last_state, last_selection;
    std::thread thread;  ///< last, so that it starts with everything in place
};

Simulation::Simulation(const LiveOptions& options, Outbox& outbox) : impl_(std::make_unique<Impl>(options, outbox)) {}
Simulation::~Simulation() = default;

void Simulation::join(ClientId client) {
    impl_->post({client, Impl::Joined{}});
}

void Simulation::leave(ClientId client) {
    impl_->post({client, Impl::Left{}});
}

void Simulation::post(ClientId client, Command command) {
    impl_->post({client, std::move(command)});
}

}  // namespace cairn::view
