//! Mara speaks a line with English subtitles, and Otto one with German subtitles. Both move a face with the blend shapes
//! of ARKit: `cargo run --example two_languages`.
//!
//! There is no window, so that the example runs anywhere. In a game, the `MorphWeights` come with a glTF scene.

use bevy::app::ScheduleRunnerPlugin;
use bevy::asset::RenderAssetUsages;
use bevy::mesh::PrimitiveTopology;
use bevy::mesh::morph::MorphWeights;
use bevy::prelude::*;
use bevy_lipz::prelude::*;
use std::time::Duration;

/// The lines: clip, speaker, language of the subtitles.
const LINES: [(&str, &str, &str); 2] =
    [("act1/mara-good-evening", "mara", "en-us"), ("act1/otto-twenty-years", "otto", "de-de")];

/// The names of the model's morph targets.
const SHAPES: [&str; 6] = ["jawOpen", "mouthFunnel", "mouthSmile_L", "mouthSmile_R", "browInnerUp", "eyeBlink_L"];

/// The number of lines that have ended.
#[derive(Resource, Default)]
struct EndedLines(usize);

/// Returns the example, which ends after the lines.
pub fn app() -> App {
    let mut app = App::new();
    let frames = ScheduleRunnerPlugin::run_loop(Duration::from_millis(33));
    app.add_plugins((MinimalPlugins.set(frames), AssetPlugin::default(), LipzPlugin))
        .init_asset::<Mesh>()
        .init_resource::<EndedLines>()
        .add_systems(Startup, spawn)
        .add_systems(Last, show_jaw)
        .add_observer(|subtitle: On<LipzSubtitle>| println!("{}", subtitle.text))
        .add_observer(|event: On<LipzEvent>| println!("({})", *event))
        .add_observer(|failed: On<LipzFailed>| eprintln!("{}", failed.error))
        .add_observer(next_line);
    app
}

fn spawn(mut commands: Commands, assets: Res<AssetServer>, mut meshes: ResMut<Assets<Mesh>>) {
    let mut head = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default());
    head.set_morph_target_names(SHAPES.map(String::from).to_vec());
    let weights = MorphWeights::new(vec![0.0; SHAPES.len()], Some(meshes.add(head)));
    let [(clip, speaker, locale), _] = LINES;
    let player = LipzPlayer::new(assets.load("act1.lipzbank"), clip).with_speaker(speaker).with_locale(locale);
    commands.spawn((player, LipzFace::default(), weights.unwrap_or_default()));
}

/// Starts the next line, or ends the example.
fn next_line(
    ended: On<LipzFinished>,
    mut lines: ResMut<EndedLines>,
    mut players: Query<&mut LipzPlayer>,
    mut exit: MessageWriter<AppExit>,
) {
    lines.0 += 1;
    match (LINES.get(lines.0), players.get_mut(ended.entity)) {
        (Some((clip, speaker, locale)), Ok(mut player)) => {
            player.speaker = (*speaker).to_owned();
            player.locale = (*locale).to_owned();
            player.play(*clip);
        }
        _ => {
            exit.write(AppExit::Success);
        }
    }
}

/// Draws how far the jaw is open.
fn show_jaw(models: Query<&MorphWeights, Changed<MorphWeights>>) {
    for model in &models {
        let jaw = model.weights().first().copied().unwrap_or_default();
        println!("  {}", "#".repeat((0_u8..40).filter(|step| f32::from(*step) < jaw * 40.0).count()));
    }
}

fn main() -> AppExit {
    app().run()
}
