//! `tags!`: one list becomes an enum whose numbers are part of the pack format, and all that is read off it.

/// Declares an enum of tags, each with its number and, behind `as`, its bit and name among the features of a
/// pack. A variant that is not in the list does not exist, so no list of them can be incomplete.
macro_rules! tags {
    ($(#[$meta:meta])* pub enum $name:ident {
        $($(#[$row:meta])* $variant:ident = $tag:literal $(as $bit:literal $title:literal)?,)*
    }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        #[repr(u32)]
        pub enum $name { $($(#[$row])* $variant = $tag,)* }

        #[allow(dead_code, reason = "not everything is asked of every list")]
        impl $name {
            /// Every one, as declared.
            pub const DECLARED: [Self; [$($tag),*].len()] = [$(Self::$variant),*];

            /// Every one, in tag order.
            pub const ALL: [Self; Self::DECLARED.len()] = {
                let mut all = Self::DECLARED;
                let mut end = 1;
                while end < all.len() {
                    let mut i = end;
                    while i > 0 && all[i - 1] as u32 > all[i] as u32 {
                        let above = all[i - 1];
                        all[i - 1] = all[i];
                        all[i] = above;
                        i -= 1;
                    }
                    end += 1;
                }
                all
            };

            /// Their tags, in the same order.
            pub const TAGS: [u32; Self::ALL.len()] = {
                let mut tags = [0; Self::ALL.len()];
                let mut i = 0;
                while i < tags.len() {
                    tags[i] = Self::ALL[i] as u32;
                    i += 1;
                }
                tags
            };

            /// Bits and names of those that are features of a pack.
            pub(crate) const FEATURES: &[(u32, &str)] = &[$($(($bit, $title),)?)*];

            /// The one with this tag.
            #[must_use]
            pub fn from_tag(tag: u32) -> Option<Self> {
                Self::ALL.into_iter().find(|known| *known as u32 == tag)
            }

            /// Its feature bit; 0 if it has none.
            #[must_use]
            pub const fn feature(self) -> u64 {
                match self { $(Self::$variant => $crate::abi::tag::tags!(@bit $($bit)?),)* }
            }

            /// Its name in small letters with underscores, as WGSL writes it: `rough_dielectric`.
            #[must_use]
            pub fn stem(self) -> String {
                $crate::abi::tag::snake(match self { $(Self::$variant => stringify!($variant),)* })
            }
        }
    };
    (@bit) => { 0 };
    (@bit $bit:literal) => { 1 << $bit };
}
pub(crate) use tags;

/// `RoughDielectric` as `rough_dielectric`.
pub(crate) fn snake(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        if c.is_ascii_uppercase() && !text.is_empty() {
            text.push('_');
        }
        text.push(c.to_ascii_lowercase());
    }
    text
}
