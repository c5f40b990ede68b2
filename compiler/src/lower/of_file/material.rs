//! Materials that are like those of mesh files: principled ones, whose images may be those of the file.

mod check;

use lang::diagnostic::{Code, Diagnostic};
use lang::scene::{
    Asset, Color, Material, MaterialModel, MaterialOfFile, MeshImage, Name, NormalMap, Placement,
    Principled, Rgb, Scalar, Scene, Texture, TextureExpression,
};
use lang::units::show_number;

use super::named::named;
use crate::import::{ImportedMaterial, MapUse, MeshFacts};
use crate::lower::material::linear;

/// Completes all materials of the scene.
pub(super) fn complete(scene: &mut Scene, assets: &[MeshFacts], diagnostics: &mut Vec<Diagnostic>) {
    let declared = scene.materials.clone();
    for (index, material) in declared.iter().enumerate() {
        let Some(of_file) = &material.of_file else { continue };
        let asset = of_file.base.asset;
        match found(scene, material, of_file, &assets[asset]) {
            Ok(from) => {
                let complete = Taken { scene, asset }.material(material, of_file, from);
                check::check(&complete, (of_file, from), diagnostics);
                scene.materials[index] = complete;
            }
            Err(error) => diagnostics.push(*error),
        }
    }
    check::mixes(&declared, &scene.materials, diagnostics);
}

/// The material of the file. Of several of one name, which differ in the colours of their vertices, one that has some
/// goes first, then one that is used.
fn found<'a>(
    scene: &Scene,
    material: &Material,
    of_file: &MaterialOfFile,
    facts: &'a MeshFacts,
) -> Result<&'a ImportedMaterial, Box<Diagnostic>> {
    let base = &of_file.base;
    let names = facts.materials.iter().map(|material| material.name.as_str());
    let found = named((scene, base), "material", names)?;
    let is_used = |index: usize| {
        facts.parts.iter().any(|part| part.material.is_some_and(|used| used as usize == index))
    };
    let rank = |index: &usize| (!facts.materials[*index].vertex_colors, !is_used(*index));
    let index = found.into_iter().min_by_key(rank).expect("something has that name");
    let from = &facts.materials[index];
    let name = &material.name.text;
    let (what, instead) = if from.unlit {
        let [r, g, b] = from.color.map(show_number);
        let color = format!("color = linear({r}, {g}, {b}), strength = 1, sides = both");
        ("unlit: it gives off its colour and scatters nothing", format!("emissive {{ {color} }}"))
    } else if from.is_glass() {
        let ior = show_number(from.ior);
        ("solid glass, which bends light", format!("dielectric {{ ior = {ior} }}"))
    } else {
        return Ok(from);
    };
    let asset = &scene.assets[base.asset];
    let text = format!("`{}` of `{}` is no principled material", from.name, asset.name.text);
    let error = Diagnostic::error(Code("E0535"), text)
        .at(base.name.span, what)
        .because(asset.path_span, "the file")
        .with_help(format!("declare it: `material {name}: {instead}`"));
    Err(Box::new(error))
}

/// What is taken from a mesh file. Its images become textures of the scene.
struct Taken<'a> {
    scene: &'a mut Scene,
    asset: usize,
}

impl Taken<'_> {
    fn material(
        &mut self,
        material: &Material,
        MaterialOfFile { base, normal_strength }: &MaterialOfFile,
        from: &ImportedMaterial,
    ) -> Material {
        let says = |field: &str| base.says(field).is_some();
        let MaterialModel::Principled(declared) = &material.model else {
            unreachable!("what is like a material of a file is principled")
        };
        let normal = match from.normal_map {
            Some(map) if !says("normal") => {
                let texture = self.texture(map);
                let says_strength = says("normal.strength");
                let strength = if says_strength { *normal_strength } else { from.normal_strength };
                Some(NormalMap { texture, strength })
            }
            _ => material.normal,
        };
        Material {
            name: material.name.clone(),
            model: MaterialModel::Principled(self.principled(declared, &says, from)),
            normal,
            projection: material.projection,
            of_file: None,
        }
    }

    fn principled(
        &mut self,
        declared: &Principled,
        says: &dyn Fn(&str) -> bool,
        from: &ImportedMaterial,
    ) -> Principled {
        let mut of = declared.clone();
        let both = from.metallic_roughness_map;
        // As lowered by itself: without highlights.
        let dull = from.diffuse_only && from.emission.iter().all(|c| *c <= 0.0);
        let specular = if dull { 0.0 } else { from.specular };
        for (field, slot, factor, map, channel) in [
            ("metallic", &mut of.metallic, from.metallic, both, 2),
            ("roughness", &mut of.roughness, from.roughness, both, 1),
            ("specular", &mut of.specular, specular, from.specular_map, 3),
            ("coat.weight", &mut of.coat, from.coat, from.coat_map, 0),
            (
                "coat.roughness",
                &mut of.coat_roughness,
                from.coat_roughness,
                from.coat_roughness_map,
                1,
            ),
            (
                "sheen.roughness",
                &mut of.sheen_roughness,
                from.sheen_roughness,
                from.sheen_roughness_map,
                3,
            ),
            ("transmission", &mut of.transmission, from.transmission, from.transmission_map, 0),
        ] {
            if !says(field) {
                *slot = self.number(factor, map.map(|map| (map, channel)), false);
            }
        }
        if !says("alpha") {
            let map = from.alpha_map.map(|map| (map, 3));
            of.alpha = self.number(from.alpha, map, from.vertex_alpha);
        }
        if !says("alpha.clip") {
            of.alpha_clip = from.alpha_clip;
        }
        for (field, slot, factor, map, colored) in [
            ("color", &mut of.color, from.color, from.color_map, from.vertex_colors),
            (
                "specular.color",
                &mut of.specular_color,
                from.specular_color,
                from.specular_color_map,
                false,
            ),
            ("sheen", &mut of.sheen, from.sheen, from.sheen_map, false),
            ("emission.color", &mut of.emission, from.emission, from.emission_map, false),
        ] {
            if !says(field) {
                *slot = self.color(factor, map, colored);
            }
        }
        for (field, slot, own) in [
            ("ior", &mut of.ior, from.ior),
            ("anisotropy", &mut of.anisotropy, from.anisotropy),
            ("anisotropy.rotation", &mut of.anisotropy_rotation, from.anisotropy_rotation),
            // That of the file is in its colour.
            ("emission.strength", &mut of.emission_strength, 1.0),
        ] {
            if !says(field) {
                *slot = own;
            }
        }
        of
    }

    /// A factor times the colours of an image, and times those of vertices if `colored`.
    fn color(&mut self, factor: Rgb, map: Option<MapUse>, colored: bool) -> Color {
        if factor.iter().all(|c| *c <= 0.0) || (map.is_none() && !colored) {
            return Color::Constant(factor);
        }
        let is_white = factor.iter().all(|c| (c - 1.0).abs() <= 0.0);
        let image = map.map(|map| self.texture(map));
        if let (Some(texture), true, false) = (image, is_white, colored) {
            return Color::Texture(texture);
        }
        let factors = [
            image.map(TextureExpression::Image),
            colored.then_some(TextureExpression::VertexColor),
            (!is_white).then_some(TextureExpression::Color(factor)),
        ];
        Color::Expression(self.product(factors))
    }

    /// A factor times a channel of an image, and times the alpha of vertices if `colored`.
    fn number(&mut self, factor: f64, map: Option<(MapUse, u8)>, colored: bool) -> Scalar {
        if factor <= 0.0 || (map.is_none() && !colored) {
            return Scalar::Constant(factor);
        }
        let is_one = (factor - 1.0).abs() <= 0.0;
        let image = map.map(|(map, channel)| (self.texture(map), channel));
        if let (Some((texture, channel)), true, false) = (image, is_one, colored) {
            return Scalar::Texture { texture, channel };
        }
        let factors = [
            image.map(|(texture, channel)| TextureExpression::Channel(texture, channel)),
            colored.then_some(TextureExpression::VertexChannel(3)),
            (!is_one).then_some(TextureExpression::Number(factor)),
        ];
        Scalar::Expression(self.product(factors))
    }

    /// The expression of a product; its index.
    fn product(&mut self, factors: [Option<TextureExpression<usize>>; 3]) -> usize {
        let product = |a, b| TextureExpression::Product(Box::new([a, b]));
        let of = factors.into_iter().flatten().reduce(product).expect("a product has factors");
        let known = &mut self.scene.expressions;
        known.iter().position(|known| *known == of).unwrap_or_else(|| {
            known.push(of);
            known.len() - 1
        })
    }

    /// The texture of an image of the file.
    fn texture(&mut self, map: MapUse) -> usize {
        let of_mesh = Some(MeshImage { asset: self.asset, image: map.image as usize });
        let Asset { name, path_span, path, .. } = &self.scene.assets[self.asset];
        let texture = Texture {
            name: Name { text: format!("{}/image {}", name.text, map.image), span: name.span },
            path: path.clone(),
            path_span: *path_span,
            space: linear(map.space),
            wrap: map.wrap,
            placement: Placement::NONE,
            of_mesh,
        };
        let known = &mut self.scene.textures;
        known.iter().position(|known| *known == texture).unwrap_or_else(|| {
            known.push(texture);
            known.len() - 1
        })
    }
}
