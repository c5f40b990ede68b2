//! The feature sets that the tests run over.

use pack::abi::{
    CameraKind, FilterKind, LightKind, MaterialKind, SamplerKind, SkyKind, TextureFormat,
};
use shaders::{FeatureSet, NodeLayout};
use std::collections::BTreeMap;
use std::sync::LazyLock;

type Switch = Box<dyn Fn(&mut FeatureSet)>;

/// Every feature, as a name and the change that switches it on.
fn features() -> Vec<(String, Switch)> {
    fn row(name: String, switch: impl Fn(&mut FeatureSet) + 'static) -> (String, Switch) {
        (name, Box::new(switch))
    }
    let mut rows: Vec<(String, Switch)> =
        OTHERS.iter().map(|(name, switch)| row((*name).to_owned(), *switch)).collect();
    for kind in MaterialKind::ALL {
        rows.push(row(kind.stem(), move |f| _ = f.materials.insert(kind)));
    }
    for kind in LightKind::ALL {
        rows.push(row(format!("{} light", kind.stem()), move |f| {
            f.lights.insert(kind);
            // Only a sky can be a light of kind sky.
            if kind == LightKind::Sky {
                f.skies.insert(SkyKind::Gradient);
            }
        }));
    }
    for kind in SkyKind::ALL {
        rows.push(row(format!("{} sky", kind.stem()), move |f| _ = f.skies.insert(kind)));
    }
    for kind in FilterKind::ALL {
        rows.push(row(format!("{} filter", kind.stem()), move |f| f.filters = [kind].into()));
    }
    for kind in CameraKind::ALL {
        rows.push(row(format!("{} camera", kind.stem()), move |f| _ = f.cameras.insert(kind)));
        rows.push(row(format!("{} camera alone", kind.stem()), move |f| f.cameras = [kind].into()));
    }
    for kind in TextureFormat::ALL {
        rows.push(row(kind.stem(), move |f| _ = f.textures.insert(kind)));
    }
    rows
}

/// A feature and what switches it on.
type Other = (&'static str, fn(&mut FeatureSet));

/// Features that are no kind of a record.
const OTHERS: &[Other] = &[
    ("triangles", |f| f.triangles = true),
    ("spheres", |f| f.spheres = true),
    ("smooth_normals", |f| f.smooth_normals = true),
    ("several lights", |f| f.light_choice = true),
    ("light tree", |f| {
        f.light_choice = true;
        f.light_tree = true;
    }),
    ("tint", |f| f.tint = true),
    ("lens", |f| f.lens = true),
    ("blades", |f| {
        f.lens = true;
        f.blades = true;
    }),
    ("unlimited", |f| f.unlimited = true),
    ("alpha clip", |f| f.alpha_clip = true),
    ("alpha blend", |f| f.alpha_blend = true),
    ("tangents", |f| f.tangents = true),
    ("objects", |f| f.objects = true),
    ("normal maps", |f| f.normal_maps = true),
    ("independent samples", |f| f.samplers = [SamplerKind::Pcg].into()),
    ("media", |f| f.media = true),
    ("scattering", |f| {
        f.media = true;
        f.scattering = true;
    }),
    ("fog", |f| f.fog = true),
    ("see-through", |f| f.through = true),
    ("sheets", |f| {
        f.through = true;
        f.sheets = true;
    }),
    ("specular", |f| principled(f).principled_specular = true),
    ("coat", |f| principled(f).principled_coat = true),
    ("transmission", |f| principled(f).principled_transmission = true),
    ("sheen", |f| principled(f).principled_sheen = true),
    ("brushed", |f| principled(f).principled_anisotropy = true),
    ("motion", |f| f.motion = true),
    ("keys", |f| {
        f.motion = true;
        f.keys = true;
    }),
    ("camera keys", |f| {
        f.motion = true;
        f.camera_keys = true;
    }),
    ("light linking", |f| f.links = true),
    ("wide nodes", |f| f.layouts = [NodeLayout::Wide].into()),
];

fn principled(features: &mut FeatureSet) -> &mut FeatureSet {
    features.materials.insert(MaterialKind::Principled);
    features
}

/// Nothing, everything, every single feature and every pair, each alone and on top of each way to have
/// geometry. Sets whose kernels are the same text are there once. Some thousand texts are linked for that, once.
pub(crate) fn feature_sets() -> &'static [(String, FeatureSet)] {
    static SETS: LazyLock<Vec<(String, FeatureSet)>> = LazyLock::new(make_feature_sets);
    &SETS
}

fn make_feature_sets() -> Vec<(String, FeatureSet)> {
    let triangles = FeatureSet { triangles: true, ..FeatureSet::empty() };
    let spheres = FeatureSet { spheres: true, ..FeatureSet::empty() };
    let both = FeatureSet { spheres: true, ..triangles.clone() };
    let bases = [
        ("", FeatureSet::empty()),
        ("triangles: ", triangles),
        ("spheres: ", spheres),
        ("both: ", both),
    ];
    // Sets that are equal have equal kernels; so do sets that differ only in what needs geometry, without it.
    let features = features();
    let mut sets = BTreeMap::from([(FeatureSet::full(), "full".to_owned())]);
    for (base_name, base) in bases {
        sets.insert(base.clone(), base_name.to_owned());
        for (i, (first, switch_first)) in features.iter().enumerate() {
            for (second, switch_second) in &features[i..] {
                let mut set = base.clone();
                switch_first(&mut set);
                switch_second(&mut set);
                sets.entry(set).or_insert_with(|| format!("{base_name}{first} + {second}"));
            }
        }
    }
    let mut kernels = BTreeMap::new();
    for (set, name) in sets {
        let text = shaders::link(&set).unwrap_or_else(|e| panic!("{name}: {e}")).text;
        kernels.entry(text).or_insert((name, set));
    }
    kernels.into_values().collect()
}
