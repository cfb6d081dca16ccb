//! The plugin: asset, loader, systems and observers.

#[cfg(feature = "face")]
use crate::face::{find_shapes, move_faces};
use crate::playback::{end_removed, play};
use crate::{BankLoader, LipzBank};
use bevy::app::{App, Plugin, Update};
use bevy::asset::AssetApp;
use bevy::ecs::schedule::{IntoScheduleConfigs, SystemSet};

/// Loads banks, and moves players, faces and sprites. It needs `AssetPlugin` and `TimePlugin`, which are in
/// `DefaultPlugins`.
#[derive(Clone, Copy, Default, Debug)]
pub struct LipzPlugin;

/// The systems of the plugin, for systems of your own that must run before or after them.
#[derive(SystemSet, Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum LipzSystems {
    /// Moves players, and triggers their events; in `Update`.
    Play,
    /// Moves faces and sprites; in `PostUpdate`.
    Show,
}

impl Plugin for LipzPlugin {
    fn build(&self, app: &mut App) {
        app.init_asset::<LipzBank>().init_asset_loader::<BankLoader>();
        #[cfg(feature = "audio")]
        app.add_systems(Update, crate::clock::listen.before(play).in_set(LipzSystems::Play));
        app.add_systems(Update, play.in_set(LipzSystems::Play)).add_observer(end_removed);
        #[cfg(feature = "face")]
        app.add_systems(bevy::app::PostUpdate, (find_shapes, move_faces).chain().in_set(LipzSystems::Show));
        #[cfg(feature = "sprite")]
        app.add_systems(bevy::app::PostUpdate, crate::sprite::show_sprites.in_set(LipzSystems::Show));
    }
}
