// Equations are where pymdownx.arithmatex marked them, and nowhere else.
window.MathJax = {
  tex2jax: {
    inlineMath: [['\\(', '\\)']],
    displayMath: [['\\[', '\\]']],
    ignoreClass: '.*|',
    processClass: 'arithmatex',
  },
  messageStyle: 'none',
  showMathMenu: false,
};
