using Lipz;
using UnityEngine;

/// <summary>
/// Mara and Otto speak a line each, with subtitles in English or German. The sample makes its faces and its silent
/// recordings itself; replace them with your own.
/// </summary>
public sealed class Conversation : MonoBehaviour
{
    private const int SampleRateHz = 24000;

    [SerializeField]
    private LipzBank bank;

    [SerializeField]
    private string language = "de-de";

    private LipzPlayer mara;
    private LipzPlayer otto;

    /// <summary>The subtitle that is shown, with the name of the speaker.</summary>
    public string Subtitle { get; private set; }

    /// <summary>The last event.</summary>
    public string LastEvent { get; private set; }

    /// <summary>Sets the bank and the language of subtitles.</summary>
    public void Set(LipzBank dialogue, string subtitleLanguage)
    {
        bank = dialogue;
        language = subtitleLanguage;
    }

    private void Start()
    {
        mara = Character("Mara", -0.6f);
        otto = Character("Otto", 0.6f);
        mara.OnFinished.AddListener(() => Speak(otto, "otto-twenty-years"));
        otto.OnFinished.AddListener(() => Subtitle = "");
        Speak(mara, "mara-good-evening");
    }

    private void Speak(LipzPlayer character, string key)
    {
        Clip clip = bank.Bank.Clip(key);
        int samples = (int)(clip.DurationUs.Value * SampleRateHz / 1000000);
        character.Play(key, AudioClip.Create(key, samples, 1, SampleRateHz, false));
    }

    private LipzPlayer Character(string characterName, float x)
    {
        var character = new GameObject(characterName);
        character.transform.position = new Vector3(x, 0f, 0f);
        var face = character.AddComponent<SkinnedMeshRenderer>();
        face.sharedMesh = FaceMesh.Make();
        face.sharedMaterial = new Material(Shader.Find("Sprites/Default"));
        character.AddComponent<LipzBlendShapes>().Face = face;
        var player = character.AddComponent<LipzPlayer>();
        player.BankAsset = bank;
        player.AudioSource = character.AddComponent<AudioSource>();
        player.Speaker = characterName.ToLowerInvariant();
        player.Locale = language;
        player.OnSubtitle.AddListener(text => Subtitle = text == "" ? "" : characterName + ": " + text);
        player.OnEvent.AddListener((who, verb, target) => LastEvent = who + " " + verb + " " + target);
        return player;
    }

    private void OnGUI()
    {
        GUI.Label(new Rect(20f, Screen.height - 60f, Screen.width, 40f), Subtitle + "   " + LastEvent);
    }
}
