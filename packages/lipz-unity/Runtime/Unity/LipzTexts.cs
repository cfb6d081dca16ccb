using UnityEngine;

namespace Lipz
{
    /// <summary>The texts of a locale as an asset. The importer makes it from a <c>.lipztexts</c> file.</summary>
    public sealed class LipzTexts : ScriptableObject
    {
        [SerializeField, HideInInspector]
        private byte[] bytes;

        /// <summary>Makes an asset from the bytes of a text bank, for example of a download.</summary>
        /// <exception cref="BankException">The bytes are not a file of lipz, or they are damaged.</exception>
        public static LipzTexts From(byte[] bytes)
        {
            Bank.VerifyTexts(bytes);
            var asset = CreateInstance<LipzTexts>();
            asset.bytes = bytes;
            return asset;
        }

        internal byte[] Bytes
        {
            get { return bytes; }
        }
    }
}
