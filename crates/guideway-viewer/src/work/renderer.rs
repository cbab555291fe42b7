use std::sync::mpsc::{self, Receiver, Sender, TryRecvError};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Instant;

use eframe::egui::{Color32, ColorImage};
use guideway_scene::{
    Budget, Cancel, EditOutcome, Frame, Method, Prepared, RenderError, Report, Style, View,
    elapsed_ms,
};
use guideway_scene::{Edit, Scene};

use super::Wake;
use crate::services::AppServices;
use guideway_layout::UserError;

/// The way of drawing that runs everywhere.
pub(crate) const FALLBACK: &str = "cpu";

/// Draws one scene beside the window: always the newest view that was asked for, and that again when the scene changes.
pub(crate) struct Renderer {
    orders: Orders,
    outcomes: Receiver<Outcome>,
    thread: Option<JoinHandle<()>>,
}

/// Where a renderer is told what has changed, from any thread.
#[derive(Clone, Default)]
pub(crate) struct Orders(Arc<Shared>);

/// What to draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shot {
    pub(crate) view: View,
    pub(crate) style: Style,
}

/// What came of it.
pub(crate) enum Outcome {
    Picture(Box<Picture>),
    /// It has no scene any more that it could draw.
    NeedsScene,
    /// It goes on by [`FALLBACK`] and not as asked: why.
    FellBack(String),
    /// There is no picture of this shot.
    Failed(String),
}

/// A finished picture.
pub(crate) struct Picture {
    pub(crate) shot: Shot,
    pub(crate) image: ColorImage,
    pub(crate) report: Report,
    /// From the view that was asked for to the finished picture.
    pub(crate) wall_ms: f64,
}

#[derive(Default)]
struct Shared {
    inbox: Mutex<Inbox>,
    bell: Condvar,
}

#[derive(Default)]
struct Inbox {
    orders: Vec<Order>,
    next: Option<Shot>,
    /// What was last asked for.
    last: Option<Shot>,
    /// What is being drawn, and what stops it.
    now: Option<(Shot, Cancel)>,
    is_closed: bool,
}

/// What is to be done next.
struct Task {
    orders: Vec<Order>,
    shot: Option<(Shot, Cancel)>,
}

enum Order {
    Scene(Arc<Scene>),
    Edit(Edit),
    Method(String),
}

impl Renderer {
    pub(crate) fn start(services: Arc<dyn AppServices>, method: &str, wake: Wake) -> Self {
        let orders = Orders::default();
        let (outcomes, thread) = Worker::spawn(&orders, services, method, wake);
        Self {
            orders,
            outcomes,
            thread: Some(thread),
        }
    }

    /// Begins anew, where the thread is gone, without a scene.
    pub(crate) fn restart(&mut self, services: Arc<dyn AppServices>, method: &str, wake: Wake) {
        self.orders.0.lock().forget();
        let (outcomes, thread) = Worker::spawn(&self.orders, services, method, wake);
        (self.outcomes, self.thread) = (outcomes, Some(thread));
    }

    /// Where it can be told of edits.
    pub(crate) fn orders(&self) -> Orders {
        self.orders.clone()
    }

    /// Draws another scene from now on.
    pub(crate) fn set_scene(&self, scene: Arc<Scene>) {
        self.orders.give(Order::Scene(scene));
    }

    /// Draws another way from now on.
    pub(crate) fn set_method(&self, name: &str) {
        self.orders.give(Order::Method(name.to_owned()));
    }

    /// Draws this next, in place of any other that waits. What is being drawn goes on if it is still of use.
    pub(crate) fn ask(&self, shot: Shot) {
        let mut inbox = self.orders.0.lock();
        if let Some((now, cancel)) = &inbox.now
            && !now.is_of_use_for(&shot)
        {
            cancel.set();
        }
        (inbox.next, inbox.last) = (Some(shot), Some(shot));
        drop(inbox);
        self.orders.0.bell.notify_one();
    }

    /// Whether something is still to be drawn.
    pub(crate) fn is_busy(&self) -> bool {
        let inbox = self.orders.0.lock();
        inbox.next.is_some() || inbox.now.is_some() || !inbox.orders.is_empty()
    }

    /// The next outcome; an error if the thread is gone.
    pub(crate) fn outcome(&self) -> Result<Outcome, TryRecvError> {
        self.outcomes.try_recv()
    }
}

impl Orders {
    /// The scene changes so.
    pub(crate) fn edit(&self, edit: Edit) {
        self.give(Order::Edit(edit));
    }

    fn give(&self, order: Order) {
        let mut inbox = self.0.lock();
        // It would show what is no longer so.
        if let Some((_, cancel)) = &inbox.now {
            cancel.set();
        }
        inbox.orders.push(order);
        inbox.next = inbox.last;
        drop(inbox);
        self.0.bell.notify_one();
    }
}

impl Drop for Renderer {
    fn drop(&mut self) {
        let mut inbox = self.orders.0.lock();
        inbox.is_closed = true;
        if let Some((_, cancel)) = &inbox.now {
            cancel.set();
        }
        drop(inbox);
        self.orders.0.bell.notify_one();
        if let Some(thread) = self.thread.take() {
            // A driver may still be at work: it must not meet the end of the process. A panic there was shown.
            let _ = thread.join();
        }
    }
}

impl Inbox {
    /// Leaves nothing to be done but the picture that was last asked for.
    fn forget(&mut self) {
        self.orders.clear();
        self.now = None;
        self.next = self.last;
    }
}

impl Shot {
    /// Whether its picture shows at least half of what another one is to show.
    fn is_of_use_for(&self, other: &Self) -> bool {
        let (a, b) = (self.view.world_bounds(), other.view.world_bounds());
        let overlap = |a: (f64, f64), b: (f64, f64)| (a.1.min(b.1) - a.0.max(b.0)).max(0.0);
        let shared = overlap((a.min.x, a.max.x), (b.min.x, b.max.x))
            * overlap((a.min.y, a.max.y), (b.min.y, b.max.y));
        let size = b.size();
        self.style == other.style && shared >= 0.5 * size.x * size.y
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Inbox> {
        // Whole at any time, so one thread's panic does not spoil it.
        self.inbox.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits for something to do; none when it is over.
    fn next(&self) -> Option<Task> {
        let mut inbox = self.lock();
        inbox.now = None;
        while !inbox.is_closed && inbox.orders.is_empty() && inbox.next.is_none() {
            inbox = self
                .bell
                .wait(inbox)
                .unwrap_or_else(PoisonError::into_inner);
        }
        if inbox.is_closed {
            return None;
        }
        inbox.now = inbox.next.take().map(|shot| (shot, Cancel::default()));
        Some(Task {
            orders: std::mem::take(&mut inbox.orders),
            shot: inbox.now.clone(),
        })
    }
}

struct Worker {
    services: Arc<dyn AppServices>,
    shared: Arc<Shared>,
    outcomes: Sender<Outcome>,
    wake: Wake,
    method_name: String,
    method: Option<Box<dyn Method>>,
    /// Until it is prepared. Later it is the method's alone, which can then change it without a copy.
    scene: Option<Arc<Scene>>,
    prepared: Option<Box<dyn Prepared>>,
    /// Whether the window knows that a scene is wanted, and has not sent one.
    has_asked: bool,
    frame: Option<Frame>,
}

impl Worker {
    fn spawn(
        orders: &Orders,
        services: Arc<dyn AppServices>,
        method: &str,
        wake: Wake,
    ) -> (Receiver<Outcome>, JoinHandle<()>) {
        let (sender, outcomes) = mpsc::channel();
        let mut worker = Self {
            services,
            shared: Arc::clone(&orders.0),
            outcomes: sender,
            wake,
            method_name: method.to_owned(),
            method: None,
            scene: None,
            prepared: None,
            // The first one comes unasked.
            has_asked: true,
            frame: None,
        };
        (outcomes, thread::spawn(move || worker.run()))
    }

    fn run(&mut self) {
        while let Some(Task { orders, shot }) = self.shared.next() {
            for order in orders {
                self.follow(order);
            }
            if let Some((shot, cancel)) = shot {
                self.draw(shot, &cancel);
            }
        }
    }

    fn follow(&mut self, order: Order) {
        match order {
            Order::Scene(scene) => {
                self.scene = Some(scene);
                self.prepared = None;
                self.has_asked = false;
            }
            Order::Edit(edit) => {
                let is_done = match (&mut self.prepared, &mut self.scene) {
                    (Some(prepared), _) => {
                        matches!(prepared.edit(&edit), Ok(EditOutcome::InPlace { .. }))
                    }
                    (None, Some(scene)) => Arc::make_mut(scene).edit(&edit).is_ok(),
                    (None, None) => false,
                };
                if !is_done {
                    // The window has the scene as it is now.
                    self.prepared = None;
                    self.scene = None;
                }
            }
            Order::Method(name) => {
                self.method_name = name;
                self.method = None;
                self.prepared = None;
            }
        }
    }

    fn draw(&mut self, shot: Shot, cancel: &Cancel) {
        let started = Instant::now();
        match self.picture(&shot, cancel, started) {
            Ok(picture) => self.tell(Outcome::Picture(Box::new(picture))),
            Err(Stop::NoScene) if self.has_asked => {}
            Err(Stop::NoScene) => {
                self.has_asked = true;
                self.tell(Outcome::NeedsScene);
            }
            Err(Stop::Render(RenderError::Cancelled)) => {}
            Err(Stop::Method(trouble)) => self.fall_back(&shot, cancel, &trouble.to_string()),
            Err(Stop::Render(error @ RenderError::Device { .. })) => {
                self.fall_back(&shot, cancel, &error.to_string());
            }
            Err(Stop::Render(error)) => self.tell(Outcome::Failed(error.to_string())),
        }
    }

    /// Goes on with the way of drawing that runs everywhere.
    fn fall_back(&mut self, shot: &Shot, cancel: &Cancel, why: &str) {
        if self.method_name == FALLBACK {
            self.tell(Outcome::Failed(why.to_owned()));
            return;
        }
        let name = &self.method_name;
        let notice = format!("{name} cannot go on: {why}. Drawing by {FALLBACK} instead");
        self.tell(Outcome::FellBack(notice));
        self.follow(Order::Method(FALLBACK.to_owned()));
        self.draw(*shot, cancel);
    }

    fn picture(&mut self, shot: &Shot, cancel: &Cancel, started: Instant) -> Result<Picture, Stop> {
        let prepared = match &mut self.prepared {
            Some(prepared) => prepared,
            none => {
                let method = match &self.method {
                    Some(method) => method,
                    None => self
                        .method
                        .insert(self.services.start_method(&self.method_name)?),
                };
                let scene = self.scene.take().ok_or(Stop::NoScene)?;
                none.insert(method.prepare(scene, &Budget::default())?)
            }
        };
        let frame = self
            .frame
            .get_or_insert_with(|| Frame::new(shot.view.size()));
        let report = prepared.render(&shot.view, &shot.style, cancel, frame)?;
        Ok(Picture {
            shot: *shot,
            image: color_image(frame),
            report,
            wall_ms: elapsed_ms(started),
        })
    }

    fn tell(&self, outcome: Outcome) {
        // Nobody hears it if the window was closed in the meantime.
        let _ = self.outcomes.send(outcome);
        (self.wake)();
    }
}

/// A frame has straight alpha, an image of egui premultiplied.
pub(crate) fn color_image(frame: &Frame) -> ColorImage {
    let color = |&[r, g, b, a]: &[u8; 4]| Color32::from_rgba_unmultiplied(r, g, b, a);
    let size = [frame.size().width(), frame.size().height()];
    let pixels = frame.pixels().iter().map(color).collect();
    ColorImage::new(size.map(|side| side as usize), pixels)
}

enum Stop {
    NoScene,
    Method(UserError),
    Render(RenderError),
}

impl From<UserError> for Stop {
    fn from(trouble: UserError) -> Self {
        Self::Method(trouble)
    }
}

impl From<RenderError> for Stop {
    fn from(error: RenderError) -> Self {
        Self::Render(error)
    }
}
