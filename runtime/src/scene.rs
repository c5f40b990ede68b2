//! A checked pack that can be rendered, and what its settings say.

use crate::kernel::walk::{Geometry, Tree, Width};
use pack::abi::RenderSettings;
use pack::{Checked, Pack};
use std::fmt::Write as _;
use std::sync::OnceLock;

/// A scene that can be rendered.
pub struct Scene {
    pack: Pack<Checked>,
    /// The tree with nodes of eight, and that with nodes of sixteen.
    trees: [OnceLock<Option<Tree>>; 2],
}

impl Scene {
    /// The scene in a checked pack.
    #[must_use]
    pub fn new(pack: Pack<Checked>) -> Self {
        Self { pack, trees: [const { OnceLock::new() }; 2] }
    }

    /// The pack.
    #[must_use]
    pub fn pack(&self) -> &Pack<Checked> {
        &self.pack
    }

    /// The tree that the CPU walks, with nodes of this width, unless the nodes of the pack are binary; made when it is
    /// first asked for.
    pub(crate) fn tree(&self, width: Width) -> Option<&Tree> {
        self.place(width).get_or_init(|| tree_of(&self.pack, width)).as_ref()
    }

    /// The same if it has been made.
    pub(crate) fn finished_tree(&self, width: Width) -> Option<&Tree> {
        self.place(width).get().and_then(Option::as_ref)
    }

    fn place(&self, width: Width) -> &OnceLock<Option<Tree>> {
        let [eights, sixteens] = &self.trees;
        if matches!(width, Width::Eight) { eights } else { sixteens }
    }

    /// Makes now what a CPU would otherwise make between the first blocks of a picture and the others, so that all
    /// blocks are rendered alike. No bit of a picture depends on it.
    pub fn prepare(&self) {
        self.tree(Width::of_processor());
    }

    /// Settings of the scene.
    #[must_use]
    pub fn settings(&self) -> &RenderSettings {
        self.pack.render()
    }

    /// The name of what is rendered, in hexadecimal.
    #[must_use]
    pub fn render_id(&self) -> String {
        let mut text = String::with_capacity(64);
        for byte in self.pack.render_id() {
            // Writing to a string cannot fail.
            let _ = write!(text, "{byte:02x}");
        }
        text
    }
}

fn tree_of(pack: &Pack<Checked>, width: Width) -> Option<Tree> {
    let nodes = pack.records();
    let geometry = Geometry {
        nodes,
        triangles: pack.records(),
        instances: pack.records(),
        root: pack.render().root,
        shades: pack.records(),
        materials: pack.records(),
        textures: pack.records(),
        texels: pack.texels().as_flattened(),
    };
    (!nodes.is_empty()).then(|| Tree::new(&geometry, width))
}
